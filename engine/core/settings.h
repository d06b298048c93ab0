#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace raylab {

/// One row of a settings table over the struct `S`: everything that the command line, the editor's widgets, JSON files and chart
/// axes know of a setting. The default is the value of the member in a default-constructed S, so it is written once.
template <class S>
struct Setting {
    using Member = std::variant<bool S::*, int64_t S::*, double S::*, std::string S::*>;

    Setting(std::string_view name_, Member member_, std::string_view unit_, std::string_view help_, double lowest_ = 0.0,
            double highest_ = 0.0, std::vector<std::string> choices_ = {})
        : name(name_), member(member_), unit(unit_), help(help_), lowest(lowest_), highest(highest_),
          choices(std::move(choices_)) {}

    std::string_view name;  ///< as on the command line: --name
    Member member;
    std::string_view unit;  ///< empty where there is none
    std::string_view help;
    double lowest;   ///< of a number
    double highest;  ///< of a number
    std::vector<std::string> choices;  ///< of a string; empty: any
};

/// A value of a setting, whatever struct it lives in.
using SettingValue = std::variant<bool, int64_t, double, std::string>;

/// What is needed to check a text that a user wrote for a setting.
struct SettingRule {
    std::string_view name;
    SettingValue kind;  ///< the alternative says the type; the value is ignored
    double lowest;
    double highest;
    std::span<const std::string> choices;
};

/// Throws Error, naming the setting and what it takes, unless `text` is a value of it.
SettingValue parseSetting(const SettingRule& rule, const std::string& text);

/// A value as parseSetting reads it back.
std::string settingText(const SettingValue& value);

/// Throws Error that lists names near to `name`.
[[noreturn]] void throwUnknownSetting(std::string_view name, std::span<const std::string_view> known);

template <class S>
SettingValue getSetting(const Setting<S>& setting, const S& values) {
    return std::visit([&](auto member) { return SettingValue(values.*member); }, setting.member);
}

template <class S>
void setSetting(const Setting<S>& setting, S& values, const std::string& text) {
    const SettingRule rule{setting.name, getSetting(setting, values), setting.lowest, setting.highest, setting.choices};
    const SettingValue value = parseSetting(rule, text);
    std::visit([&](auto member) { values.*member = std::get<std::decay_t<decltype(values.*member)>>(value); },
               setting.member);
}

/// The row of that name. Throws Error where there is none.
template <class S>
const Setting<S>& findSetting(std::span<const Setting<S>> table, std::string_view name) {
    std::vector<std::string_view> known;
    for (const Setting<S>& setting : table) {
        if (setting.name == name) return setting;
        known.push_back(setting.name);
    }
    throwUnknownSetting(name, known);
}

}  // namespace raylab
