#include "ui/actions/icons.h"

#include <QFile>
#include <QGuiApplication>
#include <QIconEngine>
#include <QPainter>
#include <QPalette>
#include <QSvgRenderer>

// The resources live in a static library; without this the linker drops them. Outside any namespace, as Qt asks.
static void load_resources() { Q_INIT_RESOURCE(atrium); }

namespace atrium::ui {

namespace {

/// Paints the vector file at the asked size every time: sharp at any device pixel ratio, tinted by the present palette.
class SvgEngine : public QIconEngine {
public:
    explicit SvgEngine(QByteArray source) : source_(std::move(source)) {}
    void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State) override {
        const QPalette palette = QGuiApplication::palette();
        const bool disabled = mode == QIcon::Disabled;
        const QColor color = mode == QIcon::Selected
                                 ? palette.color(QPalette::HighlightedText)
                                 : palette.color(disabled ? QPalette::Disabled : QPalette::Active, QPalette::WindowText);
        QByteArray tinted = source_;
        tinted.replace("currentColor", color.name(QColor::HexRgb).toLatin1());
        QSvgRenderer(tinted).render(painter, rect);
    }
    QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
        QPixmap picture(size);
        picture.fill(Qt::transparent);
        QPainter painter(&picture);
        paint(&painter, QRect(QPoint(0, 0), size), mode, state);
        return picture;
    }
    QIconEngine* clone() const override { return new SvgEngine(source_); }

private:
    QByteArray source_;
};

} // namespace

QIcon tinted_icon(const QString& name) {
    static const bool loaded = (load_resources(), true);
    (void)loaded;
    QFile file(QStringLiteral(":/icons/%1.svg").arg(name));
    if (name.isEmpty() || !file.open(QIODevice::ReadOnly)) {
        return {};
    }
    return QIcon(new SvgEngine(file.readAll()));
}

} // namespace atrium::ui
