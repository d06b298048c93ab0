#pragma once

#include <memory>
#include <typeindex>
#include <unordered_map>

namespace raylab {

/// What panels remember from frame to frame: one object of each type, made when it is first asked for. It ends before
/// the window's device does, so that it may own pictures.
class PanelStates {
public:
    template <class T>
    T& get() {
        std::shared_ptr<void>& state = states_[typeid(T)];
        if (state == nullptr) state = std::make_shared<T>();
        return *static_cast<T*>(state.get());
    }

private:
    std::unordered_map<std::type_index, std::shared_ptr<void>> states_;
};

}  // namespace raylab
