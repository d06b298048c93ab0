#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace raylab {

/// A look at one value of a JSON file that remembers where it is, so that every complaint names file and place
/// ("a.gltf: materials[3].alphaCutoff must be a number"). A key that is absent yields the fallback; a value of the
/// wrong type throws Error. The JSON document and the file name must outlive the view.
class JsonView {
public:
    JsonView(const nlohmann::json& value, std::string_view file, std::string place = "")
        : value_(&value), file_(file), place_(std::move(place)) {}

    bool has(const char* key) const { return value_->is_object() && value_->contains(key); }
    /// Elements of an array or members of an object.
    size_t size() const { return value_->size(); }
    const nlohmann::json& json() const { return *value_; }
    std::string file() const { return std::string(file_); }

    /// Empty where the key is absent.
    JsonView object(const char* key) const;
    JsonView array(const char* key) const;
    /// `i` must be below size(); throws Error unless the element is an object.
    JsonView element(size_t i) const;

    /// Finite and within the range of a float.
    double number(const char* key, double fallback) const;
    bool flag(const char* key, bool fallback) const;
    std::string text(const char* key, const std::string& fallback) const;
    size_t count(const char* key, size_t fallback) const;
    /// An index into an array of `size` elements; nothing where the key is absent.
    std::optional<size_t> index(const char* key, size_t size) const;
    /// The i-th element of this array as an index into an array of `size` elements.
    size_t indexAt(size_t i, size_t size) const;
    /// The array under `key`, which must hold exactly `values.size()` numbers.
    std::vector<double> numbers(const char* key, std::vector<double> fallback) const;
    glm::vec3 vec3(const char* key, glm::vec3 fallback) const;

    /// Throws Error: file, place of this value, then `problem`.
    [[noreturn]] void fail(const std::string& problem) const;

private:
    JsonView child(const char* key, const nlohmann::json& value) const;
    size_t checkedIndex(const nlohmann::json& value, size_t size) const;

    const nlohmann::json* value_;
    std::string_view file_;
    std::string place_;
};

}  // namespace raylab
