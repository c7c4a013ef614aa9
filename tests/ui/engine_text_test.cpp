// Messages of the engine in the user's language, and that the engine still says what the table has.
#include "ui/document/engine_text.h"

#include "engine/io/scene_file.h"
#include "engine/scene/problems.h"

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QDirIterator>
#include <QFile>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTranslator>

namespace atrium::ui {
namespace {

/// The string literals of the engine, those that stand side by side joined, values of formats and what was joined by + cut.
QStringList engine_literals() {
    QStringList out;
    QDirIterator files(QStringLiteral(ATRIUM_SOURCE_DIR "/engine"), {QStringLiteral("*.cpp"), QStringLiteral("*.h")},
                       QDir::Files, QDirIterator::Subdirectories);
    static const QRegularExpression side_by_side(QStringLiteral("\"\\s*\\n\\s*\""));
    static const QRegularExpression literal(QStringLiteral("\"((?:[^\"\\\\\\n]|\\\\.)*)\""));
    while (files.hasNext()) {
        QFile file(files.next());
        EXPECT_TRUE(file.open(QIODevice::ReadOnly));
        QString text = QString::fromUtf8(file.readAll());
        text.remove(side_by_side);
        for (auto it = literal.globalMatch(text); it.hasNext();) {
            out << it.next().captured(1).replace(QStringLiteral("\\\""), QStringLiteral("\""));
        }
    }
    return out;
}

TEST(EngineText, TheEngineSaysWhatTheTableHas) {
    const QStringList literals = engine_literals();
    ASSERT_GT(literals.size(), 1000);
    static const QRegularExpression place(QStringLiteral("%\\d"));
    for (const char* message : engine_messages()) {
        for (const QString& piece : QString::fromUtf8(message).split(place, Qt::SkipEmptyParts)) {
            const bool said =
                std::any_of(literals.begin(), literals.end(), [&](const QString& one) { return one.contains(piece); });
            EXPECT_TRUE(said) << "nothing in engine/ says \"" << piece.toStdString() << "\" of: " << message;
        }
    }
}

class FrenchEngineText : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(french_.load(QStringLiteral("atrium_fr"), QStringLiteral(":/translations")));
        QCoreApplication::installTranslator(&french_);
    }
    void TearDown() override { QCoreApplication::removeTranslator(&french_); }
    QTranslator french_;
};

TEST_F(FrenchEngineText, NamesAndNumbersStayWhereTheyBelong) {
    EXPECT_EQ(engine_text("an emissive strength of 2e12 was set to 1e10 cd/m2"),
              QStringLiteral("une \u00e9mission de 2e12 a \u00e9t\u00e9 ramen\u00e9e \u00e0 1e10 cd/m2"));
    EXPECT_EQ(engine_text("its roughness of 1.5 is outside 0 to 1"),
              QStringLiteral("sa valeur roughness de 1.5 est hors de l'intervalle de 0 \u00e0 1"));
    EXPECT_TRUE(engine_text("the extension %1_odd is not interpreted").contains(QStringLiteral("%1_odd")));
    EXPECT_EQ(engine_text("something new"), QStringLiteral("something new"));
    EXPECT_TRUE(engine_text({}).isEmpty());
}

TEST_F(FrenchEngineText, ErrorsOfRealFilesAreTranslated) {
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("not_there.glb"));
    const auto missing = read_scene(path.toStdString());
    ASSERT_FALSE(missing);
    EXPECT_TRUE(error_message(missing.error()).contains(QStringLiteral("ne peut pas \u00eatre ouvert")))
        << error_message(missing.error()).toStdString();
    EXPECT_TRUE(error_message(missing.error()).contains(path));
    QFile broken(folder.filePath(QStringLiteral("broken.gltf")));
    ASSERT_TRUE(broken.open(QIODevice::WriteOnly));
    broken.write("{\"asset\":");
    broken.close();
    const auto unread = read_scene(broken.fileName().toStdString());
    ASSERT_FALSE(unread);
    EXPECT_NE(engine_text(unread.error().hint).toStdString(), unread.error().hint);
}

TEST_F(FrenchEngineText, ProblemsOfASceneAreTranslated) {
    Scene scene;
    Material material;
    material.base_color = Rgb(1.2F);
    Node node;
    node.name = "Box";
    node.shape = scene.shapes.insert({"Box", Box{}, {}});
    node.materials = {scene.materials.insert(material)};
    Light dark;
    dark.intensity = 0.0F;
    node.light = scene.lights.insert(dark);
    scene.roots.push_back(scene.nodes.insert(node));
    const auto problems = find_problems(scene);
    ASSERT_GE(problems.size(), 2U);
    for (const Problem& problem : problems) {
        EXPECT_NE(engine_text(problem.what).toStdString(), problem.what);
    }
}

} // namespace
} // namespace atrium::ui
