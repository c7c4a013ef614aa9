#include "ui/window/appearance.h"

#include <QApplication>
#include <QProxyStyle>
#include <QStyle>
#include <QStyleFactory>
#include <QToolTip>

namespace atrium::ui {
namespace {

/// Words on the buttons of dialogs, without the style's own pictures: these are made for pale buttons, and some are black.
class WordsOnly : public QProxyStyle {
public:
    using QProxyStyle::QProxyStyle;
    int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget, QStyleHintReturn* data) const override {
        return hint == SH_DialogButtonBox_ButtonsHaveIcons ? 0 : QProxyStyle::styleHint(hint, option, widget, data);
    }
};

QPalette colors(const QColor& window, const QColor& base, const QColor& text, const QColor& faint, const QColor& button,
                const QColor& highlight, const QColor& link) {
    QPalette out(button, window);
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::ToolTipText}) {
        out.setColor(role, text);
        out.setColor(QPalette::Disabled, role, faint);
    }
    out.setColor(QPalette::Base, base);
    out.setColor(QPalette::AlternateBase, window);
    out.setColor(QPalette::ToolTipBase, base);
    out.setColor(QPalette::PlaceholderText, faint);
    out.setColor(QPalette::BrightText, Qt::red);
    out.setColor(QPalette::Highlight, highlight);
    out.setColor(QPalette::HighlightedText, Qt::white);
    out.setColor(QPalette::Disabled, QPalette::Highlight, faint);
    out.setColor(QPalette::Link, link);
    out.setColor(QPalette::LinkVisited, link);
    return out;
}

} // namespace

Appearance appearance_of(const QString& name) {
    return name == QLatin1StringView("light")  ? Appearance::Light
           : name == QLatin1StringView("dark") ? Appearance::Dark
                                               : Appearance::System;
}

QString appearance_name(Appearance appearance) {
    return appearance == Appearance::Light  ? QStringLiteral("light")
           : appearance == Appearance::Dark ? QStringLiteral("dark")
                                            : QStringLiteral("system");
}

QPalette appearance_palette(Appearance appearance) {
    switch (appearance) {
    case Appearance::Light:
        return colors(QColor(0xef, 0xef, 0xef), Qt::white, Qt::black, QColor(0x8c, 0x8c, 0x8c), QColor(0xef, 0xef, 0xef),
                      QColor(0x30, 0x8c, 0xc6), QColor(0x00, 0x57, 0xae));
    case Appearance::Dark:
        return colors(QColor(0x2b, 0x2d, 0x30), QColor(0x1e, 0x1f, 0x22), QColor(0xe4, 0xe4, 0xe4), QColor(0x80, 0x83, 0x88),
                      QColor(0x3a, 0x3d, 0x41), QColor(0x2f, 0x6f, 0xb0), QColor(0x6c, 0xb0, 0xf5));
    case Appearance::System: break;
    }
    return {};
}

void apply_appearance(Appearance appearance) {
    static const QString systems_style = QApplication::style()->name();
    static const QPalette systems_palette = QApplication::palette();
    static Appearance shown = Appearance::System;
    if (appearance == shown) {
        return;
    }
    shown = appearance;
    if (appearance == Appearance::System) {
        QApplication::setStyle(systems_style);
    } else {
        QApplication::setStyle(new WordsOnly(QStringLiteral("Fusion"))); // the application takes it
    }
    // Asked for an empty palette Qt would keep what it has.
    QApplication::setPalette(appearance == Appearance::System ? systems_palette : appearance_palette(appearance));
    QToolTip::setPalette(QApplication::palette());
}

} // namespace atrium::ui
