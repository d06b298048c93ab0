#include "ui/report/variations.h"

#include <sstream>

#include "engine/core/error.h"

namespace raylab {

std::vector<std::string> splitAt(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
}

std::string Variation::text() const {
    std::string result;
    for (const auto& [name, value] : assigned) result += (result.empty() ? "" : " ") + name + "=" + value;
    return result;
}

std::vector<Variation> gridOf(const RenderSettings& base, const std::vector<std::string>& axes) {
    std::vector<Variation> result{{base, {}}};
    for (const std::string& axis : axes) {
        const size_t equals = axis.find('=');
        if (equals == std::string::npos || equals + 1 == axis.size())
            throw Error("--vary takes NAME=A,B,C, not '" + axis + "'");
        const std::string name = axis.substr(0, equals);
        const Setting<RenderSettings>& setting = findSetting(renderSettingsTable(), name);
        std::vector<Variation> next;
        for (const Variation& variation : result)
            for (const std::string& value : splitAt(axis.substr(equals + 1), ',')) {
                Variation grown = variation;
                setSetting(setting, grown.settings, value);
                grown.assigned.emplace_back(name, value);
                next.push_back(grown);
            }
        result = std::move(next);
    }
    return result;
}

}  // namespace raylab
