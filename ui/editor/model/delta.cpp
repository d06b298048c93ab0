#include "ui/editor/model/delta.h"

#include <algorithm>

namespace raylab::editor {
namespace {

/// The shortest splice from one list to the other, by their common beginning and end.
template <class T, class Same>
Splice<T> spliceOf(const std::vector<T>& before, const std::vector<T>& after, Same&& same) {
    const size_t shorter = std::min(before.size(), after.size());
    size_t head = 0, tail = 0;
    while (head < shorter && same(before[head], after[head])) ++head;
    while (tail < shorter - head && same(before[before.size() - 1 - tail], after[after.size() - 1 - tail])) ++tail;
    const auto middle = [&](const std::vector<T>& list) {
        return std::vector<T>(list.begin() + static_cast<std::ptrdiff_t>(head),
                              list.end() - static_cast<std::ptrdiff_t>(tail));
    };
    return {head, middle(before), middle(after)};
}

template <class T>
Splice<T> spliceOf(const std::vector<T>& before, const std::vector<T>& after) {
    return spliceOf(before, after, [](const T& a, const T& b) { return a == b; });
}

template <class T>
Splice<Shared<T>> spliceOf(const SharedList<T>& before, const SharedList<T>& after) {
    return spliceOf(before.shared(), after.shared(),
                    [](const Shared<T>& a, const Shared<T>& b) { return a.sameAs(b); });
}

/// Puts `in` where `out` stands.
template <class T>
void replace(std::vector<T>& list, size_t first, const std::vector<T>& out, const std::vector<T>& in) {
    const auto at = list.begin() + static_cast<std::ptrdiff_t>(first);
    if (out.size() == in.size()) {
        std::copy(in.begin(), in.end(), at);
        return;
    }
    list.insert(list.erase(at, at + static_cast<std::ptrdiff_t>(out.size())), in.begin(), in.end());
}

template <class T>
Change<T> changeOf(bool isChanged, const T& before, const T& after) {
    return isChanged ? Change<T>{true, before, after} : Change<T>{};
}

bool sameArrays(const Mesh& a, const Mesh& b) {
    return a.positions == b.positions && a.normals == b.normals && a.uvs == b.uvs && a.tangents == b.tangents &&
           a.triangles == b.triangles && a.quadrics == b.quadrics;
}

/// Labels instead of whole meshes where nothing else has changed: a mesh may have millions of triangles.
void describeMeshes(const SharedList<Mesh>& before, const SharedList<Mesh>& after, SceneDelta& delta) {
    Splice<Shared<Mesh>> splice = spliceOf(before, after);
    const bool onlyLabels = splice.before.size() == splice.after.size() &&
                            std::equal(splice.before.begin(), splice.before.end(), splice.after.begin(),
                                       [](const Shared<Mesh>& a, const Shared<Mesh>& b) {
                                           return a.sameAs(b) || sameArrays(a.read(), b.read());
                                       });
    if (!onlyLabels) {
        delta.meshes = std::move(splice);
        return;
    }
    for (size_t i = 0; i < splice.before.size(); ++i) {
        const Mesh &a = splice.before[i].read(), &b = splice.after[i].read();
        if (a.name == b.name && a.material == b.material) continue;
        delta.meshLabels.push_back({static_cast<uint32_t>(splice.first + i), a.name, b.name, a.material, b.material});
    }
}

std::vector<SettingChange> settingChanges(const RenderSettings& before, const RenderSettings& after) {
    std::vector<SettingChange> changes;
    const auto table = renderSettingsTable();
    for (size_t row = 0; row < table.size(); ++row) {
        SettingValue a = getSetting(table[row], before), b = getSetting(table[row], after);
        if (a != b) changes.push_back({row, std::move(a), std::move(b)});
    }
    return changes;
}

void store(RenderSettings& settings, size_t row, const SettingValue& value) {
    std::visit([&](auto member) { settings.*member = std::get<std::decay_t<decltype(settings.*member)>>(value); },
               renderSettingsTable()[row].member);
}

/// `forward`: from before to after.
void play(const Delta& delta, bool forward, EditState& state) {
    const auto list = [forward](auto& target, const auto& splice) {
        replace(target, splice.first, forward ? splice.before : splice.after, forward ? splice.after : splice.before);
    };
    const auto value = [forward](auto& target, const auto& change) {
        if (change.isChanged) target = forward ? change.after : change.before;
    };
    Scene& scene = state.scene;
    value(scene.name, delta.scene.name);
    list(scene.textures.shared(), delta.scene.textures);
    list(scene.materials, delta.scene.materials);
    list(scene.meshes.shared(), delta.scene.meshes);
    for (const MeshLabelChange& label : delta.scene.meshLabels) {
        Mesh& mesh = scene.meshes[label.mesh];
        mesh.name = forward ? label.nameAfter : label.nameBefore;
        mesh.material = forward ? label.materialAfter : label.materialBefore;
    }
    list(scene.instances, delta.scene.instances);
    list(scene.cameras, delta.scene.cameras);
    list(scene.lights, delta.scene.lights);
    value(scene.environment, delta.scene.environment);
    value(scene.sky, delta.scene.sky);
    list(state.hidden, delta.hidden);
    for (const SettingChange& change : delta.settings)
        store(state.settings, change.row, forward ? change.after : change.before);
    state.selection = forward ? delta.selectionAfter : delta.selectionBefore;
}

template <class T>
size_t spliceBytes(const Splice<T>& splice) {
    return (splice.before.capacity() + splice.after.capacity()) * sizeof(T);
}

size_t meshBytes(const Mesh& mesh) {
    const auto bytes = [](const auto& list) { return list.capacity() * sizeof(list[0]); };
    return bytes(mesh.positions) + bytes(mesh.normals) + bytes(mesh.uvs) + bytes(mesh.tangents) +
           bytes(mesh.triangles) + bytes(mesh.quadrics);
}

/// Of the larger of the two sides: the other one is what the scene holds, or nothing.
template <class T, class Size>
size_t largeBytes(const Splice<Shared<T>>& splice, Size&& size) {
    size_t before = 0, after = 0;
    for (const Shared<T>& each : splice.before) before += size(each.read());
    for (const Shared<T>& each : splice.after) after += size(each.read());
    return std::max(before, after);
}

}  // namespace

bool SceneDelta::isEmpty() const {
    return !name.isChanged && textures.isEmpty() && materials.isEmpty() && meshes.isEmpty() && meshLabels.empty() &&
           instances.isEmpty() && cameras.isEmpty() && lights.isEmpty() && !environment.isChanged && !sky.isChanged;
}

bool Delta::isEmpty() const { return scene.isEmpty() && hidden.isEmpty() && settings.empty(); }

size_t Delta::bytes() const {
    size_t total = sizeof(Delta) + spliceBytes(scene.materials) + spliceBytes(scene.instances) +
                   spliceBytes(scene.cameras) + spliceBytes(scene.lights) + spliceBytes(hidden) +
                   scene.meshLabels.capacity() * sizeof(MeshLabelChange) + settings.capacity() * sizeof(SettingChange);
    total += largeBytes(scene.meshes, meshBytes);
    total += largeBytes(scene.textures, [](const Texture& t) { return t.texels.capacity() * sizeof(uint32_t); });
    if (scene.environment.isChanged)
        for (const auto* side : {&scene.environment.before, &scene.environment.after})
            if (*side) total += (*side)->radiance.pixels.capacity() * sizeof(float);
    return total;
}

SceneDelta difference(const Scene& before, const Scene& after) {
    SceneDelta delta;
    delta.name = changeOf(before.name != after.name, before.name, after.name);
    delta.textures = spliceOf(before.textures, after.textures);
    delta.materials = spliceOf(before.materials, after.materials);
    describeMeshes(before.meshes, after.meshes, delta);
    delta.instances = spliceOf(before.instances, after.instances);
    delta.cameras = spliceOf(before.cameras, after.cameras);
    delta.lights = spliceOf(before.lights, after.lights);
    delta.environment = changeOf(!before.environment.sameAs(after.environment), before.environment, after.environment);
    delta.sky = changeOf(before.sky != after.sky, before.sky, after.sky);
    return delta;
}

Delta difference(const EditState& before, const EditState& after) {
    Delta delta;
    delta.scene = difference(before.scene, after.scene);
    delta.hidden = spliceOf(before.hidden, after.hidden);
    delta.settings = settingChanges(before.settings, after.settings);
    delta.selectionBefore = before.selection;
    delta.selectionAfter = after.selection;
    return delta;
}

void apply(const Delta& delta, EditState& state) { play(delta, true, state); }

void revert(const Delta& delta, EditState& state) { play(delta, false, state); }

}  // namespace raylab::editor
