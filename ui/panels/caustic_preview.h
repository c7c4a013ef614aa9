// The caustic textures of one piece of surface, laid out as they lie on it: texels, boxes, light under the cursor.
#pragma once

#include "ui/panels/caustic_words.h"

#include <QImage>
#include <QWidget>

#include <optional>

namespace atrium::ui {

/// Pictures of a texture: whole, then halved again and again. Tone-mapped; rows go down, as a picture's do.
struct TexturePictures {
    std::vector<QImage> levels;
};
/// Makes them, with the brightest per cent of all textures just below white. Any thread; takes a while.
std::vector<TexturePictures> make_texture_pictures(const std::vector<std::shared_ptr<const CausticTexture>>& textures);

/// Wheel zooms at the cursor, a drag shifts, a double click or Return shows all boxes, again the whole piece; texels are
/// never smoothed. Pictures are made on a pool thread. UI thread only.
class CausticPreview : public QWidget {
    Q_OBJECT
public:
    explicit CausticPreview(QWidget* parent = nullptr);
    void show_row(std::optional<CausticRow> row); ///< nothing: empty
    void show_box(int box);                       ///< one box fills the view
    void fit_boxes();
    void fit_piece();
    [[nodiscard]] bool ready() const { return !making_; } ///< the pictures are those of the row
    [[nodiscard]] double zoom() const { return scale_; }  ///< pixels per metre, logical
    [[nodiscard]] int highlighted() const { return box_; }
    /// Metres on the piece, from its low corner.
    [[nodiscard]] QPointF piece_at(const QPointF& pixel) const;
    [[nodiscard]] QPointF pixel_at(const QPointF& piece) const;
    [[nodiscard]] QSize sizeHint() const override { return {260, 260}; }

Q_SIGNALS:
    void pictures_ready();

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void leaveEvent(QEvent* event) override;

private:
    enum class Fit : std::uint8_t { None, Boxes, Piece, Box };
    [[nodiscard]] QRectF box_rectangle(int box) const; ///< metres
    void fit(const QRectF& metres);
    void refit();
    void zoom_by(double factor, const QPointF& at);
    [[nodiscard]] QString caption() const;

    std::optional<CausticRow> row_;
    std::vector<TexturePictures> pictures_;
    int asked_ = 0; ///< number of the newest request for pictures
    bool making_ = false;
    Fit fit_ = Fit::Boxes;
    int box_ = -1;
    double scale_ = 1.0;
    QPointF origin_; ///< pixel of the piece's low corner
    std::optional<QPointF> cursor_;
    QPointF dragged_from_;
};

} // namespace atrium::ui
