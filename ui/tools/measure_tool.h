// Shows the light under the cursor; a click leaves a measuring point, a click on one takes it away.
#pragma once

#include "ui/tools/tool.h"

namespace atrium::ui {

class MeasureTool : public Tool {
public:
    using Tool::Tool;
    void press(const Pointer& pointer) override;
    void move(const Pointer& pointer) override;
    void release(const Pointer& pointer) override;
    void cancel() override { pressed_.reset(); }
    [[nodiscard]] bool active() const override { return pressed_.has_value(); }
    bool hover(const Pointer& pointer) override;
    void leave() override { cursor_.reset(); }
    /// Where the light is read; none while the cursor is elsewhere.
    [[nodiscard]] const std::optional<dvec2>& cursor() const { return cursor_; }

private:
    std::optional<dvec2> pressed_;
    std::optional<dvec2> cursor_;
};

} // namespace atrium::ui
