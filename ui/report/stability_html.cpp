#include <cmath>
#include <sstream>

#include "engine/core/file.h"
#include "engine/image/image_io.h"
#include "ui/report/chart_svg.h"
#include "ui/report/plot_svg.h"
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
    "0;width:24em;vertical-align:top}img{width:256px;image-rendering:pixelated}"
    "figcaption{font-size:12px}";

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
         << (row.isDefault ? "default" : "") << "\"><td>" << row.id << "</td><td>" << xmlEscaped(row.config)
         << "</td><td>";
    if (row.skipped.empty())
        html << xmlEscaped(row.number.what) << " <small>" << xmlEscaped(row.number.note) << "</small>";
    else
        html << xmlEscaped(row.provokes) << " <small>" << xmlEscaped(row.skipped) << "</small>";
    html << "</td><td class=\"n\">" << (row.skipped.empty() ? stabilityNumber(row.number.value) : "")
         << "</td><td class=\"n\">"
         << (row.skipped.empty() && std::isfinite(row.number.limit) ? stabilityNumber(row.number.limit) : "")
         << "</td><td>" << xmlEscaped(row.number.unit) << "</td><td>" << stabilityVerdict(row) << "</td></tr>\n";
}

/// Shows what there is to see of a row. `picture`: the file that its picture is written to besides.
void writeFigure(std::ostream& html, const std::filesystem::path& picture, const Row& row) {
    html << "<figure>";
    if (row.number.picture) {
        writePng(picture, *row.number.picture);
        html << "<img alt=\"\" src=\"data:image/png;base64," << base64(readFile(picture)) << "\">";
    }
    if (row.number.plot) html << plotSvg(*row.number.plot);
    html << "<figcaption><b>" << row.id << "</b>, " << xmlEscaped(row.config) << ": " << xmlEscaped(row.number.what)
         << " " << stabilityNumber(row.number.value) << " " << xmlEscaped(row.number.unit)
         << "</figcaption></figure>\n";
}

/// Of the rows that fail, or of those that do not.
void writeFigures(std::ostream& html, const std::filesystem::path& folder, const StabilityRun& run, bool fails,
                  size_t& count) {
    for (const Row& row : run.result.rows)
        if (row.fails() == fails && (row.number.picture || row.number.plot))
            writeFigure(html, folder / (row.id + "-" + std::to_string(++count) + ".png"), row);
}

}  // namespace

void writeStabilityHtml(const std::filesystem::path& folder, const StabilityRun& run) {
    std::ostringstream html;
    html << "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>raylab stability</title><style>" << kStyle
         << "</style>\n<h1>Stability</h1>\n<p>" << xmlEscaped(run.device.name) << ", " << xmlEscaped(run.device.driver)
         << (run.quick ? ", quick" : "") << (run.result.complete ? "" : ", stopped before the end")
         << ". The default fails " << run.defaultFailures()
         << " of its numbers. Bold: the default configuration; red: beyond the limit.</p>\n"
            "<table><tr><th>case<th>configuration<th>measured<th>number<th>limit<th>unit<th></tr>\n";
    for (const Row& row : run.result.rows) writeRow(html, row);
    html << "</table>\n<h2>Where it fails</h2>\n<p>Dots: rays that fail, on a map of their directions, origins or "
            "targets. Images: wrong pixels in red.</p>\n";
    size_t count = 0;
    writeFigures(html, folder, run, true, count);
    html << "<h2>How it behaves</h2>\n<p>Of numbers within their limits, and of those that are only shown.</p>\n";
    writeFigures(html, folder, run, false, count);
    html << "</html>\n";
    const std::string text = html.str();
    writeFileAtomically(folder / "stability.html", std::as_bytes(std::span(text)));
}

}  // namespace raylab
