// Click selects, Ctrl or Shift click toggles, a click on nothing clears, a drag spans a box.
#pragma once

#include "ui/tools/tool.h"

namespace atrium::ui {

class SelectTool : public Tool {
public:
    using Tool::Tool;
    void press(const Pointer& pointer) override;
    void move(const Pointer& pointer) override;
    void release(const Pointer& pointer) override;
    void cancel() override { state_ = State::Idle; }
    [[nodiscard]] bool active() const override { return state_ != State::Idle; }
    void draw(OverlayBatch& batch) const override;

protected:
    /// What a click at a point does to the selection.
    void click(const Pointer& pointer);

private:
    enum class State : std::uint8_t { Idle, Pressed, Box };
    void select_box(bool extend);
    State state_ = State::Idle;
    dvec2 start_{0.0};
    dvec2 end_{0.0};
};

} // namespace atrium::ui
