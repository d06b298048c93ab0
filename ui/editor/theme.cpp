#include "ui/editor/theme.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <filesystem>

namespace raylab {
namespace {

constexpr float kFontPixels = 14.0f;

/// The first that is installed; without any, ImGui's own bitmap font is scaled.
constexpr std::array kFonts = {"/usr/share/fonts/opentype/inter/Inter-Regular.otf",
                               "/usr/share/fonts/truetype/inter/Inter-Regular.ttf",
                               "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                               "/usr/share/fonts/TTF/DejaVuSans.ttf",
                               "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                               "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
                               "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"};

/// Greek and arrows for what panels print, besides Latin.
constexpr std::array<ImWchar, 9> kGlyphs = {0x0020, 0x024f, 0x0370, 0x03ff, 0x2010, 0x2027, 0x2190, 0x2193, 0};

void loadFont(float scale) {
    ImGuiIO& io = ImGui::GetIO();
    for (const char* path : kFonts) {
        std::error_code missing;
        if (!std::filesystem::exists(path, missing)) continue;
        ImFontConfig config;
        config.OversampleH = 2;
        config.OversampleV = 1;
        if (io.Fonts->AddFontFromFileTTF(path, std::round(kFontPixels * scale), &config, kGlyphs.data()) != nullptr)
            return;
    }
    ImFontConfig config;
    config.SizePixels = std::round(13.0f * scale);
    io.Fonts->AddFontDefault(&config);
}

ImVec4 grey(float value, float alpha = 1.0f) { return {value, value + 0.004f, value + 0.012f, alpha}; }

ImVec4 accent(float alpha) { return {color::kAccent.x, color::kAccent.y, color::kAccent.z, alpha}; }

void setColors(ImVec4* colors) {
    colors[ImGuiCol_Text] = color::kText;
    colors[ImGuiCol_TextDisabled] = color::kDim;
    colors[ImGuiCol_WindowBg] = color::kPane;
    colors[ImGuiCol_ChildBg] = grey(0.118f, 0.0f);
    colors[ImGuiCol_PopupBg] = grey(0.145f);
    colors[ImGuiCol_Border] = grey(0.22f);
    colors[ImGuiCol_BorderShadow] = grey(0.0f, 0.0f);
    colors[ImGuiCol_FrameBg] = grey(0.165f);
    colors[ImGuiCol_FrameBgHovered] = grey(0.205f);
    colors[ImGuiCol_FrameBgActive] = grey(0.235f);
    colors[ImGuiCol_TitleBg] = grey(0.095f);
    colors[ImGuiCol_TitleBgActive] = grey(0.095f);
    colors[ImGuiCol_TitleBgCollapsed] = grey(0.095f);
    colors[ImGuiCol_MenuBarBg] = grey(0.095f);
    colors[ImGuiCol_ScrollbarBg] = grey(0.118f, 0.0f);
    colors[ImGuiCol_ScrollbarGrab] = grey(0.25f);
    colors[ImGuiCol_ScrollbarGrabHovered] = grey(0.31f);
    colors[ImGuiCol_ScrollbarGrabActive] = grey(0.36f);
    colors[ImGuiCol_CheckMark] = color::kAccent;
    colors[ImGuiCol_SliderGrab] = accent(0.75f);
    colors[ImGuiCol_SliderGrabActive] = color::kAccent;
    colors[ImGuiCol_Button] = grey(0.20f);
    colors[ImGuiCol_ButtonHovered] = grey(0.25f);
    colors[ImGuiCol_ButtonActive] = accent(0.55f);
    colors[ImGuiCol_Header] = accent(0.22f);
    colors[ImGuiCol_HeaderHovered] = accent(0.30f);
    colors[ImGuiCol_HeaderActive] = accent(0.40f);
    colors[ImGuiCol_Separator] = grey(0.20f);
    colors[ImGuiCol_SeparatorHovered] = accent(0.60f);
    colors[ImGuiCol_SeparatorActive] = color::kAccent;
    colors[ImGuiCol_ResizeGrip] = grey(0.0f, 0.0f);
    colors[ImGuiCol_ResizeGripHovered] = accent(0.4f);
    colors[ImGuiCol_ResizeGripActive] = accent(0.8f);
    colors[ImGuiCol_Tab] = grey(0.095f);
    colors[ImGuiCol_TabHovered] = grey(0.22f);
    colors[ImGuiCol_TabActive] = grey(0.165f);
    colors[ImGuiCol_TabUnfocused] = grey(0.095f);
    colors[ImGuiCol_TabUnfocusedActive] = grey(0.165f);
    colors[ImGuiCol_PlotLines] = color::kAccent;
    colors[ImGuiCol_PlotHistogram] = color::kAccent;
    colors[ImGuiCol_TableHeaderBg] = grey(0.145f);
    colors[ImGuiCol_TableBorderStrong] = grey(0.20f);
    colors[ImGuiCol_TableBorderLight] = grey(0.165f);
    colors[ImGuiCol_TableRowBg] = grey(0.0f, 0.0f);
    colors[ImGuiCol_TableRowBgAlt] = {1.0f, 1.0f, 1.0f, 0.018f};
    colors[ImGuiCol_TextSelectedBg] = accent(0.35f);
    colors[ImGuiCol_NavHighlight] = accent(0.8f);
    colors[ImGuiCol_ModalWindowDimBg] = {0.0f, 0.0f, 0.0f, 0.45f};
}

}  // namespace

namespace color {
const ImVec4 kPane{0.118f, 0.122f, 0.130f, 1.0f};
const ImVec4 kView{0.070f, 0.072f, 0.078f, 1.0f};
const ImVec4 kAccent{0.36f, 0.62f, 0.90f, 1.0f};
const ImVec4 kText{0.86f, 0.87f, 0.885f, 1.0f};
const ImVec4 kDim{0.53f, 0.545f, 0.57f, 1.0f};
const ImVec4 kWarning{0.92f, 0.74f, 0.38f, 1.0f};
const ImVec4 kError{0.94f, 0.45f, 0.42f, 1.0f};
const ImVec4 kGood{0.52f, 0.80f, 0.52f, 1.0f};
const ImVec4 kSelection{1.0f, 0.64f, 0.20f, 1.0f};
}  // namespace color

void applyTheme(float scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowPadding = {10.0f, 8.0f};
    style.FramePadding = {7.0f, 3.0f};
    style.ItemSpacing = {7.0f, 5.0f};
    style.ItemInnerSpacing = {6.0f, 4.0f};
    style.CellPadding = {6.0f, 3.0f};
    style.IndentSpacing = 16.0f;
    style.ScrollbarSize = 11.0f;
    style.GrabMinSize = 9.0f;
    style.WindowBorderSize = 0.0f;
    style.ChildBorderSize = 0.0f;
    style.PopupBorderSize = 1.0f;
    style.FrameBorderSize = 0.0f;
    style.TabBorderSize = 0.0f;
    style.WindowRounding = 0.0f;
    style.ChildRounding = 0.0f;
    style.PopupRounding = 4.0f;
    style.FrameRounding = 3.0f;
    style.GrabRounding = 3.0f;
    style.TabRounding = 3.0f;
    style.ScrollbarRounding = 6.0f;
    style.WindowMenuButtonPosition = ImGuiDir_None;
    setColors(style.Colors);
    style.ScaleAllSizes(scale);
    loadFont(scale);
}

}  // namespace raylab
