#pragma once

#include <filesystem>
#include <string>

namespace raylab {

/// The file that a scene in `folder` means by `uri`: percent escapes decoded (RFC 3986, section 2.1), backslashes taken
/// for slashes; where that does not exist, the name as it stands, then the bare file name beside the scene (paths of
/// the author's own disk). If none exists, the first of these, for the message.
std::filesystem::path resolveResource(const std::filesystem::path& folder, const std::string& uri);

}  // namespace raylab
