#include "engine/caustics/restriction.h"

#include <algorithm>
#include <limits>

namespace atrium {

CellBox united(const CellBox& a, const CellBox& b) {
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

std::vector<CellBox> component_boxes(const std::vector<std::uint8_t>& marked, int width, int height) {
    std::vector<std::uint8_t> todo = marked;
    std::vector<CellBox> out;
    std::vector<int> stack;
    for (int start = 0; start < width * height; ++start) {
        if (todo[std::size_t(start)] == 0) {
            continue;
        }
        CellBox box{width, height, 0, 0};
        stack.push_back(start);
        todo[std::size_t(start)] = 0;
        while (!stack.empty()) {
            const int at = stack.back();
            stack.pop_back();
            const int x = at % width, y = at / width;
            box = united(box, {x, y, x + 1, y + 1});
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v) {
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) {
                    if (todo[std::size_t(v * width + u)] != 0) {
                        todo[std::size_t(v * width + u)] = 0;
                        stack.push_back(v * width + u);
                    }
                }
            }
        }
        out.push_back(box);
    }
    return out;
}

std::vector<CellBox> merge_boxes(std::vector<CellBox> boxes, double waste, std::size_t most) {
    for (;;) {
        std::size_t best_i = 0, best_j = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            for (std::size_t j = i + 1; j < boxes.size(); ++j) {
                const CellBox both = united(boxes[i], boxes[j]);
                const CellBox common{std::max(boxes[i].x0, boxes[j].x0), std::max(boxes[i].y0, boxes[j].y0),
                                     std::min(boxes[i].x1, boxes[j].x1), std::min(boxes[i].y1, boxes[j].y1)};
                const double ratio = common.empty() ? both.area() / (boxes[i].area() + boxes[j].area()) : 0.0;
                if (ratio < least) {
                    least = ratio;
                    best_i = i;
                    best_j = j;
                }
            }
        }
        if (boxes.size() < 2 || (least > waste && boxes.size() <= most)) {
            return boxes;
        }
        boxes[best_i] = united(boxes[best_i], boxes[best_j]);
        boxes.erase(boxes.begin() + std::ptrdiff_t(best_j));
    }
}

} // namespace atrium
