#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace raylab {

enum class OpenMode { replace, merge, environment, texture, save };

/// Asks for a file to read, or for a name to save under.
class FileDialog {
public:
    /// `name`: what stands in the field, of a file that is to be saved.
    void open(OpenMode mode, const std::filesystem::path& name = {});
    OpenMode mode() const { return mode_; }

    /// Draws it while it is open. Returns the file that was chosen.
    std::optional<std::filesystem::path> draw(float scale);

private:
    void enter(const std::filesystem::path& folder);
    bool drawEntries();
    std::filesystem::path chosenFile() const;

    bool opening_ = false;
    OpenMode mode_ = OpenMode::replace;
    std::filesystem::path folder_;
    std::string text_;
    std::vector<std::filesystem::directory_entry> entries_;
};

}  // namespace raylab
