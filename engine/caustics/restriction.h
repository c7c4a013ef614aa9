// Where on a chart a caustic texture has to be: boxes around what is lit.
#pragma once

#include <cstdint>
#include <vector>

namespace atrium {

/// Cells [x0, x1) x [y0, y1).
struct CellBox {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    [[nodiscard]] bool empty() const { return x1 <= x0 || y1 <= y0; }
    [[nodiscard]] double area() const { return empty() ? 0.0 : double(x1 - x0) * double(y1 - y0); }
    [[nodiscard]] bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
    friend bool operator==(const CellBox&, const CellBox&) = default;
};
CellBox united(const CellBox& a, const CellBox& b);

/// Bounding boxes of the connected regions (eight neighbours) of marked cells, in the order of their first cell: the flood
/// fill of PAPER section 2.5.
std::vector<CellBox> component_boxes(const std::vector<std::uint8_t>& marked, int width, int height);

/// Boxes that overlap become one; so do those whose common box is at most `waste` times their areas together, and then the
/// pairs that waste least until `most` are left.
std::vector<CellBox> merge_boxes(std::vector<CellBox> boxes, double waste, std::size_t most);

} // namespace atrium
