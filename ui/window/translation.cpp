#include "ui/window/translation.h"

#include <QCoreApplication>
#include <QDir>
#include <QLibraryInfo>
#include <QLocale>
#include <QTranslator>

namespace atrium::ui {

namespace {
const QString kEnglish = QStringLiteral("en");
}

QStringList languages() {
    QStringList out{kEnglish};
    const QStringList files =
        QDir(QStringLiteral(":/translations")).entryList({QStringLiteral("atrium_*.qm")}, QDir::Files, QDir::Name);
    for (const QString& file : files) {
        out += file.mid(7).chopped(3);
    }
    return out;
}

QString language_name(const QString& code) {
    QString name = QLocale(code).nativeLanguageName();
    if (code == kEnglish) {
        return QStringLiteral("English"); // not "American English"
    }
    if (!name.isEmpty()) {
        name[0] = name[0].toUpper();
    }
    return name.isEmpty() ? code : name;
}

QString chosen_language(const QString& wanted) {
    const QStringList known = languages();
    if (known.contains(wanted)) {
        return wanted;
    }
    const QStringList system = QLocale::system().uiLanguages();
    for (const QString& language : system) {
        const QString code = language.section(QLatin1Char('-'), 0, 0).section(QLatin1Char('_'), 0, 0);
        if (known.contains(code)) {
            return code;
        }
    }
    return kEnglish;
}

void install_language(const QString& code) {
    if (code == kEnglish) {
        return;
    }
    // The one installed last is asked first: ours knows the few texts of Qt's that matter, for where Qt's own are not there.
    for (const auto& [file, folder] :
         {std::pair{QStringLiteral("qtbase_") + code, QLibraryInfo::path(QLibraryInfo::TranslationsPath)},
          std::pair{QStringLiteral("atrium_") + code, QStringLiteral(":/translations")}}) {
        auto* translator = new QTranslator(QCoreApplication::instance());
        if (translator->load(file, folder)) {
            QCoreApplication::installTranslator(translator);
        } else {
            delete translator;
        }
    }
}

} // namespace atrium::ui
