#include <imgui.h>

#include <algorithm>

#include "engine/scene/f0_presets.h"
#include "ui/editor/model/edit_materials.h"
#include "ui/editor/panels/inspector.h"
#include "ui/editor/places.h"
#include "ui/editor/texture_thumbnails.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

using editor::TextureSlot;

/// Widgets over the fields of one material: what they change becomes an edit, one step a drag.
class MaterialFields {
public:
    MaterialFields(EditorContext& context, uint32_t index)
        : material(context.state.scene().materials[index]), context_(context), index_(index) {}

    void share(const char* label, float& value, const char* tip) {
        commit(ImGui::SliderFloat(label, &value, 0.0f, 1.0f, "%.3f"), label);
        notePlace(context_, std::string("material-") + label);
        inspectorTip(tip);
    }
    void number(const char* label, float& value, float low, float high, float speed, const char* tip) {
        commit(ImGui::DragFloat(label, &value, speed, low, high, "%.3f"), label);
        inspectorTip(tip);
    }
    void color(const char* label, glm::vec3& value, const char* tip) {
        commit(ImGui::ColorEdit3(label, &value.x, ImGuiColorEditFlags_Float), label);
        inspectorTip(tip);
    }
    void flag(const char* label, bool& value, const char* tip) {
        commit(ImGui::Checkbox(label, &value), label);
        inspectorTip(tip);
    }
    void commit(bool isChanged, const char* what) {
        if (!isChanged) return;
        const std::string key = std::string(what) + " of material " + std::to_string(index_);
        applyEdit(context_, editor::setMaterial(index_, material, what, key));
    }

    Material material;  ///< as the widgets have it

private:
    EditorContext& context_;
    uint32_t index_;
};

void drawPresets(EditorContext& context, uint32_t index) {
    if (ImGui::Button("Preset")) ImGui::OpenPopup("presets");
    inspectorTip("Reflectance of a substance at normal incidence; roughness and pictures stay");
    if (!ImGui::BeginPopup("presets")) return;
    for (const F0Preset& preset : f0Presets()) {
        const ImVec4 swatch(preset.f0.x, preset.f0.y, preset.f0.z, 1.0f);
        ImGui::ColorButton(preset.name.data(), swatch, ImGuiColorEditFlags_NoTooltip,
                           {ImGui::GetTextLineHeight(), ImGui::GetTextLineHeight()});
        ImGui::SameLine();
        if (ImGui::MenuItem(preset.name.data(), preset.isMetal ? "metal" : ""))
            applyEdit(context, editor::applyPreset(index, std::string(preset.name)));
    }
    ImGui::EndPopup();
}

void drawClipboard(EditorContext& context, uint32_t index) {
    const Scene& scene = context.state.scene();
    drawPresets(context, index);
    ImGui::SameLine();
    if (ImGui::Button("Copy")) ImGui::SetClipboardText(editor::materialText(scene.materials[index], scene).c_str());
    ImGui::SameLine();
    if (ImGui::Button("Paste")) {
        const char* held = ImGui::GetClipboardText();
        const std::string text = held == nullptr ? "" : held;
        tryEdit(context, [&] { return editor::pasteMaterial(index, text); });
    }
    ImGui::SameLine();
    if (ImGui::Button("Duplicate")) {
        Material copy = scene.materials[index];
        copy.name += " copy";
        applyEdit(context, editor::addMaterial(std::move(copy)));
    }
    inspectorTip("A new material like this one; assign it to things to keep it");
}

/// Scales the emission without losing its colour where it is 0.
void drawEmission(MaterialFields& fields) {
    glm::vec3& emission = fields.material.emission;
    float strength = std::max({emission.x, emission.y, emission.z});
    glm::vec3 tint = strength > 0.0f ? emission / strength : glm::vec3(1.0f);
    bool changed = ImGui::ColorEdit3("emission", &tint.x, ImGuiColorEditFlags_Float);
    changed |= ImGui::DragFloat("strength", &strength, std::max(0.01f, 0.01f * strength), 0.0f, 1e9f, "%.3f");
    inspectorTip("Radiance of the brightest of red, green and blue; 0: it gives no light");
    if (changed) emission = tint * strength;
    fields.commit(changed, "emission");
}

void drawAlpha(MaterialFields& fields) {
    int mode = static_cast<int>(fields.material.alphaMode);
    if (ImGui::Combo("alpha", &mode, "opaque\0cut out\0blended\0")) {
        fields.material.alphaMode = static_cast<AlphaMode>(mode);
        fields.commit(true, "alpha mode");
    }
    if (mode == 0) return;
    fields.share("opacity", fields.material.alpha, "Times the alpha of the base colour's picture");
    if (mode == 1) fields.share("cutoff", fields.material.alphaCutoff, "Below this opacity there is nothing");
}

void drawPhong(MaterialFields& fields) {
    bool own = fields.material.phong.has_value();
    if (ImGui::Checkbox("a Phong form of its own", &own)) {
        fields.material.phong = own ? std::optional(PhongMaterial{}) : std::nullopt;
        fields.commit(true, "Phong form");
    }
    inspectorTip("What the integrator whitted sees; without it, a form derived from the above");
    if (!fields.material.phong) return;
    PhongMaterial& phong = *fields.material.phong;
    ImGui::PushID("phong");
    fields.color("diffuse", phong.diffuse, "k_d");
    fields.color("specular", phong.specular, "k_s, of the highlight");
    fields.number("exponent", phong.exponent, 1.0f, 10000.0f, std::max(0.1f, 0.01f * phong.exponent),
                  "p of the highlight");
    fields.color("mirror", phong.mirror, "Multiplies mirrored light; of a metal: its reflectance at normal incidence");
    fields.color("tint", phong.tint, "Multiplies light that passes, at each surface; black: opaque");
    fields.share("reflection", phong.reflection, "Share that is mirrored under --reflection fixed");
    fields.number("refraction", phong.ior, 1.0f, kOpaqueIor, 0.005f, "n; from 10,000 on: a metal");
    ImGui::PopID();
}

std::string textureName(const Scene& scene, int32_t texture) {
    if (texture == kNoTexture) return "none";
    const Texture& t = scene.textures[static_cast<size_t>(texture)];
    const std::string file = std::filesystem::path(t.name).filename().string();
    return file.empty() ? "picture " + std::to_string(texture) : file;
}

/// The pictures of the scene, to choose one from.
void drawTextureChoice(EditorContext& context, uint32_t material, TextureSlot slot) {
    if (!ImGui::BeginPopup("choose")) return;
    const Scene& scene = context.state.scene();
    std::optional<int32_t> chosen;
    if (ImGui::MenuItem("Load...")) {
        context.texturePlace = {material, slot};
        context.fileDialog.open(OpenMode::texture);
    }
    if (ImGui::MenuItem("None")) chosen = kNoTexture;
    ImGui::Separator();
    for (int32_t t = 0; t < static_cast<int32_t>(scene.textures.size()); ++t) {
        ImGui::PushID(t);
        drawThumbnail(context, scene.textures[static_cast<size_t>(t)], 32.0f * context.scale);
        ImGui::SameLine();
        if (ImGui::MenuItem(textureName(scene, t).c_str())) chosen = t;
        ImGui::PopID();
    }
    ImGui::EndPopup();
    if (chosen) applyEdit(context, editor::setTexture(material, slot, *chosen));
}

void drawTextureSlot(EditorContext& context, uint32_t material, TextureSlot slot) {
    const Scene& scene = context.state.scene();
    const int32_t texture = editor::textureAt(scene.materials[material], slot);
    ImGui::PushID(editor::textureSlotName(slot));
    const float side = 40.0f * context.scale;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton("slot", {side, side})) ImGui::OpenPopup("choose");
    const bool hovered = ImGui::IsItemHovered();
    ImGui::GetWindowDrawList()->AddRect(at, {at.x + side, at.y + side},
                                        ImGui::GetColorU32(hovered ? color::kAccent : color::kDim));
    if (texture != kNoTexture) {
        const Texture& shown = scene.textures[static_cast<size_t>(texture)];
        drawThumbnailAt(context, shown, at, side);
        if (hovered)
            ImGui::SetTooltip("%s\n%u x %u, %s", shown.name.c_str(), shown.width, shown.height,
                              shown.srgb ? "sRGB" : "linear");
    }
    drawTextureChoice(context, material, slot);
    ImGui::SameLine();
    ImGui::BeginGroup();
    ImGui::TextUnformatted(editor::textureSlotName(slot));
    ImGui::TextColored(color::kDim, "%s", textureName(context.state.scene(), texture).c_str());
    ImGui::EndGroup();
    ImGui::PopID();
}

}  // namespace

void inspectMaterial(EditorContext& context, uint32_t index) {
    ImGui::PushID("material");
    MaterialFields fields(context, index);
    Material& m = fields.material;
    if (editName(m.name)) fields.commit(true, "name");
    drawClipboard(context, index);
    fields.color("base colour", m.baseColor, "Of the diffuse part; of a metal, its reflectance. Linear sRGB");
    fields.share("metallic", m.metallic, "0: a dielectric over a diffuse base; 1: a metal");
    fields.share("roughness", m.roughness, "Perceptual: alpha of GGX is its square");
    fields.share("specular", m.specular, "Scales the dielectric reflection; 0: purely Lambertian");
    fields.number("refraction", m.ior, 1.0f, 4.0f, 0.005f, "Index of refraction, of reflection and transmission");
    fields.share("transmission", m.transmission, "Share of light that enters instead of being scattered back");
    fields.flag("thin sheet", m.thin, "Light passes without refraction: a pane, not the boundary of a volume");
    drawEmission(fields);
    fields.flag("both sides emit", m.doubleSided, "Other shading has two sides always");
    drawAlpha(fields);
    if (m.normalTexture != kNoTexture)
        fields.number("bumps", m.normalScale, -4.0f, 4.0f, 0.01f, "Strength of the normal map");
    if (ImGui::CollapsingHeader("Pictures", ImGuiTreeNodeFlags_DefaultOpen))
        for (const TextureSlot slot : editor::kTextureSlots) drawTextureSlot(context, index, slot);
    if (ImGui::CollapsingHeader("Whitted")) drawPhong(fields);
    ImGui::PopID();
}

}  // namespace raylab
