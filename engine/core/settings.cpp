#include "engine/core/settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "engine/core/error.h"

namespace raylab {
namespace {

std::string number(double value) {
    char buffer[32];
    const auto [end, code] = std::to_chars(buffer, buffer + sizeof(buffer), value);
    return {buffer, end};
}

template <class T>
T parseNumber(const SettingRule& rule, const std::string& text, const char* kind) {
    T value{};
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size())
        throw Error("--" + std::string(rule.name) + " takes " + kind + ", not '" + text + "'");
    const double asDouble = static_cast<double>(value);
    if (!(asDouble >= rule.lowest && asDouble <= rule.highest))
        throw Error("--" + std::string(rule.name) + " takes " + kind + " from " + number(rule.lowest) + " to " +
                    number(rule.highest) + ", not " + text);
    return value;
}

bool parseBool(const SettingRule& rule, const std::string& text) {
    if (text == "true" || text == "on" || text == "1") return true;
    if (text == "false" || text == "off" || text == "0") return false;
    throw Error("--" + std::string(rule.name) + " takes on or off, not '" + text + "'");
}

std::string parseChoice(const SettingRule& rule, const std::string& text) {
    if (rule.choices.empty() || std::find(rule.choices.begin(), rule.choices.end(), text) != rule.choices.end())
        return text;
    std::string all;
    for (const std::string& choice : rule.choices) all += (all.empty() ? "" : ", ") + choice;
    throw Error("--" + std::string(rule.name) + " is one of " + all + ", not '" + text + "'");
}

/// Levenshtein distance.
size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 1; i <= a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t above = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
            diagonal = above;
        }
    }
    return row.back();
}

}  // namespace

SettingValue parseSetting(const SettingRule& rule, const std::string& text) {
    if (std::holds_alternative<bool>(rule.kind)) return parseBool(rule, text);
    if (std::holds_alternative<int64_t>(rule.kind)) return parseNumber<int64_t>(rule, text, "a whole number");
    if (std::holds_alternative<double>(rule.kind)) return parseNumber<double>(rule, text, "a number");
    return parseChoice(rule, text);
}

std::string settingText(const SettingValue& value) {
    if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "on" : "off";
    if (const int64_t* whole = std::get_if<int64_t>(&value)) return std::to_string(*whole);
    if (const double* real = std::get_if<double>(&value)) return number(*real);
    return std::get<std::string>(value);
}

void throwUnknownSetting(std::string_view name, std::span<const std::string_view> known) {
    std::string near;
    for (const std::string_view candidate : known)
        if (editDistance(name, candidate) <= 2) near += (near.empty() ? "" : ", ") + std::string(candidate);
    throw Error("there is no setting '" + std::string(name) + "'" +
                (near.empty() ? "" : "; did you mean " + near + "?") + " (--help lists them all)");
}

}  // namespace raylab
