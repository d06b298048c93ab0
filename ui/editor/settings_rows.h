#pragma once

#include "engine/render/render_settings.h"

namespace raylab {

/// A table for rows of settings, which ImGui::EndTable() ends where it returns true.
bool beginSettingsTable(const char* id);

/// A row of the table: name and widget. A value that differs from that of `standards`, which is called `standardName`,
/// is lit, and a right click on its name takes that value. True where `settings` has changed.
bool drawSettingRow(const Setting<RenderSettings>& row, RenderSettings& settings, const RenderSettings& standards,
                    const char* standardName);

}  // namespace raylab
