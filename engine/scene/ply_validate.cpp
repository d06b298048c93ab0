#include "engine/scene/ply_validate.h"

#include <array>
#include <charconv>
#include <cstring>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/file.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

enum class Format { ascii, littleEndian, bigEndian };

struct Property {
    size_t valueSize = 0;
    size_t countSize = 0;  ///< of a list's length; 0: a single value
};

struct Element {
    std::string name;
    size_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    Format format = Format::ascii;
    std::vector<Element> elements;
};

/// Cuts a text into lines ("\n" or "\r\n"), counting them.
class Lines {
public:
    Lines(std::string_view text, const fs::path& path) : text_(text), path_(path) {}

    /// Throws Error at the end of the file.
    std::string_view next() {
        ++number_;
        const size_t end = text_.find('\n', offset_);
        if (offset_ >= text_.size()) fail("the file ends too early");
        std::string_view line = text_.substr(offset_, end == std::string_view::npos ? end : end - offset_);
        offset_ = end == std::string_view::npos ? text_.size() : end + 1;
        if (line.ends_with('\r')) line.remove_suffix(1);
        return line;
    }
    std::string_view rest() const { return text_.substr(offset_); }
    [[noreturn]] void fail(std::string problem) const {
        // What it quotes may be binary.
        for (char& c : problem)
            if (c < ' ' || c > '~') c = '?';
        throw Error(path_.string() + ":" + std::to_string(number_) + ": damaged PLY: " + problem +
                    "; copy or export the file again");
    }

private:
    std::string_view text_;
    const fs::path& path_;
    size_t offset_ = 0;
    size_t number_ = 0;
};

size_t sizeOfType(const std::string& type, const Lines& lines) {
    constexpr std::array<std::pair<std::string_view, size_t>, 16> kSizes = {{{"char", 1},
                                                                             {"uchar", 1},
                                                                             {"int8", 1},
                                                                             {"uint8", 1},
                                                                             {"short", 2},
                                                                             {"ushort", 2},
                                                                             {"int16", 2},
                                                                             {"uint16", 2},
                                                                             {"int", 4},
                                                                             {"uint", 4},
                                                                             {"int32", 4},
                                                                             {"uint32", 4},
                                                                             {"float", 4},
                                                                             {"float32", 4},
                                                                             {"double", 8},
                                                                             {"float64", 8}}};
    for (const auto& [name, size] : kSizes)
        if (type == name) return size;
    lines.fail("\"" + type + "\" is not a type");
}

Property parseProperty(std::istringstream& words, const Lines& lines) {
    std::string type, name;
    Property property;
    words >> type;
    if (type == "list") {
        std::string countType;
        words >> countType >> type;
        property.countSize = sizeOfType(countType, lines);
    }
    property.valueSize = sizeOfType(type, lines);
    if (!(words >> name)) lines.fail("a property has no name");
    return property;
}

Format parseFormat(std::istringstream& words, const Lines& lines) {
    std::string format, version;
    words >> format >> version;
    if (version != "1.0") lines.fail("only version 1.0 is known");
    if (format == "ascii") return Format::ascii;
    if (format == "binary_little_endian") return Format::littleEndian;
    if (format == "binary_big_endian") return Format::bigEndian;
    lines.fail("\"" + format + "\" is not a format");
}

/// Leaves `lines` at the first byte of the body.
Header parseHeader(Lines& lines) {
    if (lines.next() != "ply") lines.fail("the first line must be \"ply\"");
    Header header;
    bool hasFormat = false;
    for (std::string_view line = lines.next(); line != "end_header"; line = lines.next()) {
        std::istringstream words{std::string(line)};
        std::string keyword;
        words >> keyword;
        if (keyword == "format") {
            header.format = parseFormat(words, lines);
            hasFormat = true;
        } else if (keyword == "element") {
            Element element;
            if (!(words >> element.name >> element.count)) lines.fail("an element needs a name and a count");
            header.elements.push_back(element);
        } else if (keyword == "property") {
            if (header.elements.empty()) lines.fail("a property comes before the first element");
            header.elements.back().properties.push_back(parseProperty(words, lines));
        } else if (keyword != "comment" && keyword != "obj_info") {
            lines.fail("\"" + keyword.substr(0, 40) + "\" is not a keyword of the header");
        }
    }
    if (!hasFormat) lines.fail("the header names no format");
    return header;
}

uint64_t readCount(std::string_view bytes, size_t size, Format format) {
    uint64_t count = 0;
    for (size_t i = 0; i < size; ++i) {
        const size_t at = format == Format::bigEndian ? i : size - 1 - i;
        count = (count << 8) | static_cast<unsigned char>(bytes[at]);
    }
    return count;
}

/// Walks over one element; false where the body is too short.
bool skipBinaryElement(std::string_view& body, const Element& element, Format format) {
    for (const Property& property : element.properties) {
        uint64_t values = 1;
        if (body.size() < property.countSize) return false;
        if (property.countSize > 0) values = readCount(body, property.countSize, format);
        body.remove_prefix(property.countSize);
        if (values > body.size() || values * property.valueSize > body.size()) return false;
        body.remove_prefix(values * property.valueSize);
    }
    return true;
}

void checkBinaryBody(std::string_view body, const Header& header, const Lines& lines) {
    for (const Element& element : header.elements)
        for (size_t i = 0; i < element.count && !element.properties.empty(); ++i)
            if (!skipBinaryElement(body, element, header.format))
                lines.fail("the file ends before " + element.name + " " + std::to_string(i + 1) + " of " +
                           std::to_string(element.count));
}

/// The next number of a line, which loses it. Throws Error where there is none.
double takeNumber(std::string_view& line, const Lines& lines) {
    while (!line.empty() && (line.front() == ' ' || line.front() == '\t' || line.front() == '+')) line.remove_prefix(1);
    double number = 0.0;
    const auto [end, code] = std::from_chars(line.data(), line.data() + line.size(), number);
    // Underflow and overflow are numbers too; the importer deals with what is not finite.
    const bool isNumber = code == std::errc() || code == std::errc::result_out_of_range;
    line.remove_prefix(static_cast<size_t>(end - line.data()));
    if (!isNumber || (!line.empty() && line.front() != ' ' && line.front() != '\t'))
        lines.fail("a number is missing or damaged");
    return number;
}

void checkAsciiBody(Lines& lines, const Header& header) {
    for (const Element& element : header.elements)
        for (size_t i = 0; i < element.count; ++i) {
            std::string_view line = lines.next();
            for (const Property& property : element.properties) {
                const double values = property.countSize > 0 ? takeNumber(line, lines) : 1.0;
                if (!(values >= 0.0 && values <= static_cast<double>(line.size())))
                    lines.fail("a list has a wrong length");
                for (size_t v = 0; v < static_cast<size_t>(values); ++v) takeNumber(line, lines);
            }
        }
}

}  // namespace

void validatePly(const fs::path& path) {
    const std::vector<std::byte> bytes = readFile(path);
    Lines lines({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
    const Header header = parseHeader(lines);
    if (header.format == Format::ascii)
        checkAsciiBody(lines, header);
    else
        checkBinaryBody(lines.rest(), header, lines);
}

}  // namespace raylab
