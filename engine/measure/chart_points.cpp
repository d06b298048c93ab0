#include "engine/measure/chart_points.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/file.h"

namespace raylab {
namespace {

constexpr std::array<std::string_view, 3> kMeasureNames = {"relative", "rmse", "flip"};
constexpr std::array<std::string_view, 16> kColumns = {
    "config", "seed", "samples", "deviceSeconds", "wallSeconds",    "rmse",        "relMse",           "flip",
    "error",  "low",  "high",    "pareto",        "paretoPossible", "biasSquared", "biasSquaredError", "variance"};

std::string number(double value) {
    if (std::isnan(value)) return {};
    std::array<char, 32> buffer{};
    const auto [end, code] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), end};
}

/// RFC 4180.
std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

const ChartBias* findBias(const std::vector<ChartBias>& biases, const ChartPoint& point) {
    const auto found = std::ranges::find_if(
        biases, [&](const ChartBias& bias) { return bias.samples == point.samples && bias.config == point.config; });
    return found != biases.end() ? &*found : nullptr;
}

std::vector<std::string> splitCsvLine(std::string_view line) {
    std::vector<std::string> fields(1);
    bool inQuotes = false;
    for (size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"' && inQuotes && i + 1 < line.size() && line[i + 1] == '"') {
            fields.back() += '"';
            ++i;
        } else if (line[i] == '"') {
            inQuotes = !inQuotes;
        } else if (line[i] == ',' && !inQuotes) {
            fields.emplace_back();
        } else if (line[i] != '\r') {
            fields.back() += line[i];
        }
    }
    return fields;
}

/// A line of a table, with what an error message needs.
class CsvRow {
public:
    CsvRow(const std::filesystem::path& path, size_t line, const std::vector<std::string>& header,
           std::vector<std::string> fields)
        : path_(path), line_(line), header_(header), fields_(std::move(fields)) {
        if (fields_.size() != header_.size())
            fail("has " + std::to_string(fields_.size()) + " fields instead of " + std::to_string(header_.size()));
    }

    const std::string& text(std::string_view column) const {
        const auto found = std::ranges::find(header_, column);
        if (found == header_.end()) fail("the table has no column '" + std::string(column) + "'");
        return fields_[static_cast<size_t>(found - header_.begin())];
    }

    template <class T>
    T value(std::string_view column) const {
        const std::string& field = text(column);
        T result{};
        const auto [end, code] = std::from_chars(field.data(), field.data() + field.size(), result);
        if (code != std::errc() || end != field.data() + field.size())
            fail("column '" + std::string(column) + "' has '" + field + "', which is no number");
        return result;
    }

    double valueOrNaN(std::string_view column) const {
        return text(column).empty() ? std::numeric_limits<double>::quiet_NaN() : value<double>(column);
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(path_.string() + ":" + std::to_string(line_) + ": " + what +
                    "; delete the file, or write the chart to another folder");
    }

    const std::filesystem::path& path_;
    size_t line_;
    const std::vector<std::string>& header_;
    std::vector<std::string> fields_;
};

void readRow(const CsvRow& row, ChartTable& table) {
    table.points.push_back({row.text("config"), row.value<uint32_t>("seed"), row.value<uint32_t>("samples"),
                            row.value<double>("deviceSeconds"), row.value<double>("wallSeconds"),
                            row.valueOrNaN("rmse"), row.valueOrNaN("relMse"), row.valueOrNaN("flip")});
    const ChartPoint& point = table.points.back();
    if (!row.text("biasSquared").empty() && findBias(table.biases, point) == nullptr)
        table.biases.push_back(
            {point.config,
             point.samples,
             {row.value<double>("biasSquared"), row.value<double>("biasSquaredError"), row.value<double>("variance")}});
}

}  // namespace

ErrorMeasure parseErrorMeasure(const std::string& text) {
    const auto found = std::ranges::find(kMeasureNames, text);
    if (found == kMeasureNames.end()) throw Error("an error is one of relative, rmse, flip, not '" + text + "'");
    return static_cast<ErrorMeasure>(found - kMeasureNames.begin());
}

std::string_view nameOf(ErrorMeasure measure) { return kMeasureNames[static_cast<size_t>(measure)]; }

std::vector<std::string> errorMeasureNames() { return {kMeasureNames.begin(), kMeasureNames.end()}; }

double ChartPoint::error(ErrorMeasure measure) const {
    if (measure == ErrorMeasure::relative) return std::sqrt(relMse);
    return measure == ErrorMeasure::rmse ? rmse : flip;
}

std::string chartCsv(const ChartTable& table, const std::vector<ChartMark>& marks, ErrorMeasure measure) {
    std::string text;
    for (const std::string_view column : kColumns) text += (text.empty() ? "" : ",") + std::string(column);
    text += "\n";
    for (size_t i = 0; i < table.points.size(); ++i) {
        const ChartPoint& p = table.points[i];
        const ChartMark& mark = marks[i];
        text += quoted(p.config) + "," + std::to_string(p.seed) + "," + std::to_string(p.samples);
        for (const double value :
             {p.deviceSeconds, p.wallSeconds, p.rmse, p.relMse, p.flip, p.error(measure), mark.low, mark.high})
            text += "," + number(value);
        text += mark.pareto ? ",1" : ",0";
        text += mark.paretoPossible ? ",1" : ",0";
        const ChartBias* bias = findBias(table.biases, p);
        const BiasEstimate none{std::nan(""), std::nan(""), std::nan("")};
        const BiasEstimate& estimate = bias != nullptr ? bias->estimate : none;
        for (const double value : {estimate.biasSquared, estimate.standardError, estimate.variance})
            text += "," + number(value);
        text += "\n";
    }
    return text;
}

ChartTable readChartCsv(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = readFile(path);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    ChartTable table;
    std::vector<std::string> header;
    size_t line = 0;
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view content = text.substr(begin, end - begin);
        begin = end + 1;
        ++line;
        if (content.empty()) continue;
        if (header.empty())
            header = splitCsvLine(content);
        else
            readRow(CsvRow(path, line, header, splitCsvLine(content)), table);
    }
    return table;
}

}  // namespace raylab
