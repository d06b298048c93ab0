#pragma once

struct ImVec4;

namespace raylab {

/// The editor's look: dark, calm, one accent. Sets colours and sizes of ImGui's style and loads the font, all times
/// `scale`.
void applyTheme(float scale);

/// Colours that panels use by their meaning.
namespace color {
extern const ImVec4 kPane;  ///< behind panels: what a frame begins with
extern const ImVec4 kView;  ///< around the viewport's picture
extern const ImVec4 kAccent;
extern const ImVec4 kText;
extern const ImVec4 kDim;
extern const ImVec4 kWarning;
extern const ImVec4 kError;
extern const ImVec4 kGood;
extern const ImVec4 kSelection;  ///< of what is selected in the viewport
}  // namespace color

}  // namespace raylab
