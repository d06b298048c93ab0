#pragma once

#include <span>
#include <string>
#include <string_view>

#include "ui/editor/context.h"

namespace raylab {

/// Something that a menu and a key do: one row in actions.cpp. The list of keys is drawn from the same table.
struct Action {
    std::string_view menu;  ///< File, Edit, View or Help
    std::string_view name;
    int key = 0;  ///< GLFW's; 0: none
    int mods = 0;
    void (*run)(EditorContext& context);
    bool (*enabled)(const EditorContext& context) = nullptr;  ///< nullptr: always
    bool (*checked)(const EditorContext& context) = nullptr;  ///< nullptr: not a switch
};

std::span<const Action> actionTable();

/// "Ctrl+O"; empty where there is no key.
std::string keyText(int key, int mods);

/// Runs the actions whose keys were pressed, unless a text is being typed.
void runKeys(EditorContext& context);

/// Draws the menu bar and the dialogs that it opens. Returns its height.
float drawMenuBar(EditorContext& context);

}  // namespace raylab
