#include <cmath>
#include <sstream>

#include "engine/core/file.h"
#include "engine/image/image_io.h"
#include "ui/report/stability_output.h"

namespace raylab {
namespace {

using stability::Row;

constexpr const char* kStyle =
    "body{font:14px/1.45 system-ui,sans-serif;max-width:75em;margin:2em auto;padding:0 1em;color:#222;background:#fff}"
    "table{border-collapse:collapse;width:100%}td,th{padding:.2em .6em;text-align:left;border-bottom:1px solid #ddd;"
    "vertical-align:top}td.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}"
    "tr.fail td{background:#fde8e6}tr.skipped td{color:#888}tr.default "
    "td{font-weight:600}small{font-weight:400;color:#666}"
    "figure{display:inline-block;margin:1em 1em 0 "
    "0;width:17em;vertical-align:top}img{width:256px;image-rendering:pixelated}"
    "figcaption{font-size:12px}";

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
    return result;
}

/// RFC 4648, section 4.
std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t word = 0;
        for (size_t j = 0; j < 3; ++j)
            word = (word << 8) | (i + j < bytes.size() ? std::to_integer<uint32_t>(bytes[i + j]) : 0u);
        for (size_t j = 0; j < 4; ++j) text += i + j <= bytes.size() ? kLetters[(word >> (18 - 6 * j)) & 63u] : '=';
    }
    return text;
}

void writeRow(std::ostream& html, const Row& row) {
    html << "<tr class=\"" << (row.fails() ? "fail " : "") << (row.skipped.empty() ? "" : "skipped ")
         << (row.isDefault ? "default" : "") << "\"><td>" << row.id << "</td><td>" << escaped(row.config)
         << "</td><td>";
    if (row.skipped.empty())
        html << escaped(row.number.what) << " <small>" << escaped(row.number.note) << "</small>";
    else
        html << escaped(row.provokes) << " <small>" << escaped(row.skipped) << "</small>";
    html << "</td><td class=\"n\">" << (row.skipped.empty() ? stabilityNumber(row.number.value) : "")
         << "</td><td class=\"n\">"
         << (row.skipped.empty() && std::isfinite(row.number.limit) ? stabilityNumber(row.number.limit) : "")
         << "</td><td>" << escaped(row.number.unit) << "</td><td>" << stabilityVerdict(row) << "</td></tr>\n";
}

/// Writes the picture and shows it from within the page.
void writeFigure(std::ostream& html, const std::filesystem::path& path, const Row& row) {
    writePng(path, *row.number.picture);
    html << "<figure><img alt=\"\" src=\"data:image/png;base64," << base64(readFile(path)) << "\"><figcaption><b>"
         << row.id << "</b>, " << escaped(row.config) << ": " << escaped(row.number.what) << " "
         << stabilityNumber(row.number.value) << " " << escaped(row.number.unit) << "</figcaption></figure>\n";
}

}  // namespace

void writeStabilityHtml(const std::filesystem::path& folder, const StabilityRun& run) {
    std::ostringstream html;
    html << "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>raylab stability</title><style>" << kStyle
         << "</style>\n<h1>Stability</h1>\n<p>" << escaped(run.device.description().name) << ", "
         << escaped(run.device.description().driver) << (run.quick ? ", quick" : "")
         << (run.result.complete ? "" : ", stopped before the end") << ". The default fails " << run.defaultFailures()
         << " of its numbers. Bold: the default configuration; red: beyond the limit.</p>\n"
            "<table><tr><th>case<th>configuration<th>measured<th>number<th>limit<th>unit<th></tr>\n";
    for (const Row& row : run.result.rows) writeRow(html, row);
    html << "</table>\n<h2>Where it fails</h2>\n<p>Dots: rays that fail, on a map of their directions or origins. "
            "Images: "
            "wrong pixels in red.</p>\n";
    size_t count = 0;
    for (const Row& row : run.result.rows)
        if (row.fails() && row.number.picture)
            writeFigure(html, folder / (row.id + "-" + std::to_string(++count) + ".png"), row);
    html << "</html>\n";
    const std::string text = html.str();
    writeFileAtomically(folder / "stability.html", std::as_bytes(std::span(text)));
}

}  // namespace raylab
