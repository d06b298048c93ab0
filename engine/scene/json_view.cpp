#include "engine/scene/json_view.h"

#include <cmath>

#include "engine/core/error.h"

namespace raylab {
namespace {

const nlohmann::json kEmptyObject = nlohmann::json::object();
const nlohmann::json kEmptyArray = nlohmann::json::array();

double checkedNumber(const JsonView& place, const nlohmann::json& value) {
    if (!value.is_number()) place.fail("must be a number");
    const double number = value.get<double>();
    if (!(std::abs(number) < 1e38)) place.fail("is a number beyond the range of a float");
    return number;
}

}  // namespace

void JsonView::fail(const std::string& problem) const {
    throw Error(file() + ": " + (place_.empty() ? "the document" : place_) + " " + problem +
                "; correct the file or export it again");
}

JsonView JsonView::child(const char* key, const nlohmann::json& value) const {
    return JsonView(value, file_, place_.empty() ? key : place_ + "." + key);
}

JsonView JsonView::object(const char* key) const {
    if (!has(key)) return child(key, kEmptyObject);
    const JsonView found = child(key, (*value_)[key]);
    if (!found.value_->is_object()) found.fail("must be an object");
    return found;
}

JsonView JsonView::array(const char* key) const {
    if (!has(key)) return child(key, kEmptyArray);
    const JsonView found = child(key, (*value_)[key]);
    if (!found.value_->is_array()) found.fail("must be an array");
    return found;
}

JsonView JsonView::element(size_t i) const {
    const JsonView found((*value_)[i], file_, place_ + "[" + std::to_string(i) + "]");
    if (!found.value_->is_object()) found.fail("must be an object");
    return found;
}

double JsonView::number(const char* key, double fallback) const {
    if (!has(key)) return fallback;
    const JsonView found = child(key, (*value_)[key]);
    return checkedNumber(found, *found.value_);
}

bool JsonView::flag(const char* key, bool fallback) const {
    if (!has(key)) return fallback;
    const JsonView found = child(key, (*value_)[key]);
    if (!found.value_->is_boolean()) found.fail("must be true or false");
    return found.value_->get<bool>();
}

std::string JsonView::text(const char* key, const std::string& fallback) const {
    if (!has(key)) return fallback;
    const JsonView found = child(key, (*value_)[key]);
    if (!found.value_->is_string()) found.fail("must be a string");
    return found.value_->get<std::string>();
}

size_t JsonView::count(const char* key, size_t fallback) const {
    if (!has(key)) return fallback;
    const JsonView found = child(key, (*value_)[key]);
    // Some exporters write 36.0: an integer by value is taken for one.
    const double number = checkedNumber(found, *found.value_);
    if (number < 0.0 || number != std::floor(number) || number > 9e15) found.fail("must be a whole number, 0 or more");
    return static_cast<size_t>(number);
}

size_t JsonView::checkedIndex(const nlohmann::json& value, size_t size) const {
    const double number = checkedNumber(*this, value);
    if (number < 0.0 || number != std::floor(number)) fail("must be an index");
    if (number >= static_cast<double>(size))
        fail("is " + value.dump() + ", but there are only " + std::to_string(size) + " to choose from");
    return static_cast<size_t>(number);
}

std::optional<size_t> JsonView::index(const char* key, size_t size) const {
    if (!has(key)) return std::nullopt;
    const JsonView found = child(key, (*value_)[key]);
    return found.checkedIndex(*found.value_, size);
}

size_t JsonView::indexAt(size_t i, size_t size) const {
    const JsonView found((*value_)[i], file_, place_ + "[" + std::to_string(i) + "]");
    return found.checkedIndex(*found.value_, size);
}

std::vector<double> JsonView::numbers(const char* key, std::vector<double> fallback) const {
    if (!has(key)) return fallback;
    const JsonView found = array(key);
    if (found.size() != fallback.size()) found.fail("must hold " + std::to_string(fallback.size()) + " numbers");
    for (size_t i = 0; i < fallback.size(); ++i) fallback[i] = checkedNumber(found, (*found.value_)[i]);
    return fallback;
}

glm::vec3 JsonView::vec3(const char* key, glm::vec3 fallback) const {
    const std::vector<double> values = numbers(key, {fallback.x, fallback.y, fallback.z});
    return glm::vec3(values[0], values[1], values[2]);
}

}  // namespace raylab
