#include "ui/editor/context.h"

#include "engine/core/error.h"
#include "engine/core/log.h"

namespace raylab {

bool applyEdit(EditorContext& context, const editor::Edit& edit) {
    try {
        return context.state.document->apply(edit);
    } catch (const Error& error) {
        logError(edit.name + ": " + error.what());
        return false;
    }
}

bool tryEdit(EditorContext& context, const std::function<editor::Edit()>& make) {
    try {
        return applyEdit(context, make());
    } catch (const Error& error) {
        logError(error.what());
        return false;
    }
}

}  // namespace raylab
