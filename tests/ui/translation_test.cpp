// The other language: compiled into the program, found by the contexts that the program uses, chosen by taste or by the
// system.
#include "engine/solver/memory_budget.h"
#include "ui/document/library.h"
#include "ui/window/preferences_dialog.h"
#include "ui/window/settings.h"
#include "ui/window/translation.h"
#include "window_fixture.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QPushButton>
#include <QTranslator>

namespace atrium::ui {
namespace {

TEST(Translation, FrenchIsInTheProgramUnderTheContextsThatItAsksFor) {
    ASSERT_TRUE(languages().contains(QStringLiteral("fr")));
    QTranslator french;
    ASSERT_TRUE(french.load(QStringLiteral("atrium_fr"), QStringLiteral(":/translations")));
    QCoreApplication::installTranslator(&french);
    EXPECT_EQ(MainWindow::tr("&File"), QStringLiteral("&Fichier"));
    EXPECT_EQ(QCoreApplication::translate("Actions", "&Save"), QStringLiteral("&Enregistrer"));
    EXPECT_EQ(QCoreApplication::translate("Tools", "Cancelled"), QStringLiteral("Annul\u00e9"));
    EXPECT_EQ(QCoreApplication::translate("Library", "Wax"), QStringLiteral("Cire"));
    EXPECT_EQ(MainWindow::tr("%n measuring point(s) copied.", nullptr, 1), QStringLiteral("1 point de mesure copi\u00e9."));
    EXPECT_EQ(MainWindow::tr("%n measuring point(s) copied.", nullptr, 3),
              QStringLiteral("3 points de mesure copi\u00e9s."));
    EXPECT_EQ(QCoreApplication::translate("QPlatformTheme", "Cancel"), QStringLiteral("Annuler"))
        << "buttons of Qt's, where its own translations are not installed";
    // Every command, through the table itself.
    const Actions actions;
    for (const ActionInfo& info : action_table()) {
        const QString tip = QString::fromUtf8(info.tip);
        EXPECT_NE(actions[info.id]->statusTip(), tip) << info.key;
    }
    QCoreApplication::removeTranslator(&french);
    EXPECT_EQ(MainWindow::tr("&File"), QStringLiteral("&File"));
}

TEST(Translation, TheLanguageIsTheUsersOrElseTheSystems) {
    EXPECT_EQ(chosen_language(QStringLiteral("fr")), QStringLiteral("fr"));
    EXPECT_EQ(chosen_language(QStringLiteral("en")), QStringLiteral("en"));
    const QByteArray before = qgetenv("LC_ALL");
    const QByteArray language = qgetenv("LANGUAGE");
    qunsetenv("LANGUAGE");
    for (const auto& [system, code] :
         {std::pair{"fr_CA.UTF-8", "fr"}, std::pair{"de_DE.UTF-8", "en"}, std::pair{"C.UTF-8", "en"}}) {
        qputenv("LC_ALL", system);
        QLocale::setDefault(QLocale::c()); // makes Qt look at the environment again
        EXPECT_EQ(chosen_language({}), QLatin1StringView(code)) << system;
        EXPECT_EQ(chosen_language(QStringLiteral("xx")), QLatin1StringView(code)) << "one that is gone";
    }
    qputenv("LC_ALL", before);
    if (!language.isEmpty()) {
        qputenv("LANGUAGE", language);
    }
    EXPECT_EQ(language_name(QStringLiteral("fr")), QStringLiteral("Fran\u00e7ais"));
}

TEST_F(WindowTest, PreferencesAreKept) {
    trigger(ActionId::Preferences);
    auto* preferences = dialog<PreferencesDialog>();
    ASSERT_NE(preferences, nullptr);
    auto* language = preferences->findChild<QComboBox*>(QStringLiteral("language"));
    auto* autosave = preferences->findChild<QComboBox*>(QStringLiteral("autosave"));
    auto* memory = preferences->findChild<QComboBox*>(QStringLiteral("memory"));
    ASSERT_TRUE(language != nullptr && autosave != nullptr && memory != nullptr);
    EXPECT_EQ(memory->currentData().toInt(), 0) << "half of the machine's";
    EXPECT_EQ(memory_budget(), default_memory_budget());
    memory->setCurrentIndex(memory->findData(256));
    EXPECT_TRUE(language->currentData().toString().isEmpty());
    EXPECT_EQ(autosave->currentData().toInt(), 30);
    language->setCurrentIndex(language->findData(QStringLiteral("fr")));
    autosave->setCurrentIndex(autosave->findData(60));
    auto* colours = preferences->findChild<QComboBox*>(QStringLiteral("appearance"));
    ASSERT_NE(colours, nullptr);
    colours->setCurrentIndex(colours->findData(QStringLiteral("dark")));
    const auto icon_of_open = [this] {
        const QImage picture = window->action(ActionId::Open)->icon().pixmap(24, 24).toImage();
        int brightest = 0;
        for (int y = 0; y < picture.height(); ++y) {
            for (int x = 0; x < picture.width(); ++x) {
                brightest = qAlpha(picture.pixel(x, y)) > 128 ? std::max(brightest, qGray(picture.pixel(x, y))) : brightest;
            }
        }
        return brightest;
    };
    const int light_window = window->palette().color(QPalette::Window).lightness();
    QTest::mouseClick(preferences->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok), Qt::LeftButton);
    settle();
    EXPECT_EQ(Settings().language(), QStringLiteral("fr"));
    EXPECT_EQ(Settings().autosave_seconds(), 60);
    EXPECT_EQ(Settings().appearance(), Appearance::Dark);
    EXPECT_EQ(Settings().memory_mib(), 256);
    EXPECT_EQ(memory_budget(), std::size_t(256) << 20U) << "for the light that comes next";
    set_memory_budget(0);
    Settings().set_memory_mib(0);
    EXPECT_LT(window->palette().color(QPalette::Window).lightness(), 80) << "at once";
    EXPECT_GT(light_window, 160);
    EXPECT_GT(icon_of_open(), 160) << "icons are seen on the dark";
    apply_appearance(Appearance::Light);
    settle();
    EXPECT_GT(window->palette().color(QPalette::Window).lightness(), 160);
    EXPECT_LT(icon_of_open(), 100);
    Settings().set_appearance(Appearance::System);
    Settings().set_language({});
    Settings().set_autosave_seconds(30);
}

} // namespace
} // namespace atrium::ui
