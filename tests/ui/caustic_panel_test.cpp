// The caustic inspector: what it says, how rows are kept, and how it drives selection, view and edits.
#include "window_fixture.h"

#include "engine/io/scene_file.h"
#include "ui/panels/caustic_panel.h"
#include "ui/panels/caustic_places.h"
#include "ui/panels/caustic_preview.h"
#include "ui/panels/caustic_table_model.h"

#include <QComboBox>
#include <QDockWidget>
#include <QHeaderView>
#include <QItemSelectionModel>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QTableView>
#include <QTableWidget>

#include <cstdio>

namespace atrium::ui {
namespace {

using Decision = CausticRecord::Decision;

CausticRow row_of(std::uint32_t node, const char* name, Decision decision, double lumen) {
    CausticRow row;
    row.name = QString::fromUtf8(name);
    CausticRecord& r = row.record;
    r.node = NodeId{node, 1};
    r.decision = r.found = decision;
    r.particles = 12'345;
    r.dispersion = 41.5F;
    r.threshold = 6.0F;
    r.contrast = 0.9F;
    r.extent = {4.0F, 2.0F};
    if (decision == Decision::Texture) {
        r.width = 800;
        r.height = 400;
        r.sizing = CausticRecord::Sizing::Footprints;
        r.kernel = 0.012F;
        r.boxes = {vec4(0.25F, 0.25F, 0.5F, 0.75F)};
        r.power_texture = lumen;
        r.bytes = 1'500'000;
    } else {
        r.power_mesh = lumen;
    }
    return row;
}

TEST(CausticWords, SayWhatWasDecidedAndWhy) {
    const CausticRow texture = row_of(1, "Floor", Decision::Texture, 120);
    EXPECT_EQ(caustic_decision_text(texture), QStringLiteral("Texture"));
    EXPECT_EQ(caustic_reason_text(texture),
              QStringLiteral("Finer detail than the mesh has (41.5 deviations beyond chance, 6 needed)"));
    EXPECT_NEAR(texture.texel(), 0.005, 1e-9);
    EXPECT_NEAR(texture.coverage(), 0.125, 1e-9);
    EXPECT_EQ(caustic_kernel_text(texture), QStringLiteral("12 mm"));
    EXPECT_EQ(caustic_sizing_text(texture), QStringLiteral("Half as wide as narrow kernels"));
    CausticRow mesh = row_of(2, "Wall", Decision::Uniform, 3);
    EXPECT_EQ(caustic_decision_text(mesh), QStringLiteral("Mesh"));
    EXPECT_TRUE(caustic_reason_text(mesh).startsWith(QStringLiteral("As even as chance allows")));
    EXPECT_TRUE(caustic_sizing_text(mesh).isEmpty());
    mesh.record.decision = mesh.record.found = Decision::TooFew;
    EXPECT_EQ(caustic_reason_text(mesh), QStringLiteral("Too few particles to say"));
    // Set by hand: said so, with what it would have been.
    CausticRow forced = row_of(3, "Floor", Decision::Texture, 1);
    forced.record.wish.show = CausticWish::Show::Mesh;
    forced.record.decision = Decision::SetToMesh;
    forced.record.wish.threshold = 9.0F;
    EXPECT_EQ(caustic_decision_text(forced), QStringLiteral("Mesh (by hand)"));
    EXPECT_TRUE(caustic_reason_text(forced).startsWith(QStringLiteral("Set by hand to the mesh; found: finer detail")));
    EXPECT_TRUE(caustic_reason_text(forced).contains(QStringLiteral("(set by hand)"))) << "the threshold";
    // The paper's rule is about contrast.
    CausticRow paper = texture;
    paper.paper = true;
    paper.record.threshold = 0.6F;
    EXPECT_TRUE(caustic_reason_text(paper).contains(QStringLiteral("contrast 0.90, 0.60 needed")));
}

TEST(CausticWords, SayWhyThereIsNothing) {
    EXPECT_FALSE(caustic_nothing_text(nullptr).isEmpty());
    Solution solution;
    solution.final = true;
    solution.statistics.features = {{"particles", false, "There is no specular surface in the scene."},
                                    {"caustic_textures", false, "There is no specular surface in the scene."}};
    EXPECT_EQ(caustic_nothing_text(&solution).count(QStringLiteral("There is no specular surface in the scene.")), 1);
    solution.caustic_records.push_back(row_of(1, "", Decision::Texture, 5).record);
    EXPECT_TRUE(caustic_nothing_text(&solution).isEmpty());
    solution.statistics.energy.emitted = 100;
    solution.statistics.particles_emitted = 1000;
    EXPECT_TRUE(caustic_summary_text(solution).startsWith(QStringLiteral("1 texture, ")));
    EXPECT_TRUE(caustic_summary_text(solution).endsWith(QStringLiteral("5.0 % of the scene's light")))
        << caustic_summary_text(solution).toStdString();
}

TEST(CausticTable, SortsByValueAndFiltersByText) {
    CausticTableModel model;
    CausticFilter filter;
    filter.setSourceModel(&model);
    model.set_rows({row_of(1, "Floor", Decision::Texture, 9), row_of(2, "Wall", Decision::Texture, 120),
                    row_of(3, "Ceiling", Decision::Uniform, 7)});
    const auto names = [&] {
        QStringList out;
        for (int i = 0; i < filter.rowCount(); ++i) {
            out += filter.index(i, 0).data().toString();
        }
        return out.join(QLatin1Char(' '));
    };
    filter.sort(CausticTableModel::InTextures, Qt::DescendingOrder);
    EXPECT_EQ(names(), QStringLiteral("Wall Floor Ceiling")) << "120 lm before 9 lm";
    filter.sort(CausticTableModel::Surface, Qt::AscendingOrder);
    EXPECT_EQ(names(), QStringLiteral("Ceiling Floor Wall"));
    filter.set_text(QStringLiteral("CHANCE even"));
    EXPECT_EQ(names(), QStringLiteral("Ceiling"));
    filter.set_text(QStringLiteral("wall"));
    EXPECT_EQ(names(), QStringLiteral("Wall"));
    filter.set_text({});
    EXPECT_EQ(filter.rowCount(), 3);
    for (int column = 0; column < CausticTableModel::ColumnCount; ++column) {
        EXPECT_FALSE(model.headerData(column, Qt::Horizontal, Qt::DisplayRole).toString().isEmpty());
        EXPECT_FALSE(model.headerData(column, Qt::Horizontal, Qt::ToolTipRole).toString().isEmpty());
        EXPECT_FALSE(model.index(0, column).data().toString().isEmpty()) << column;
    }
    const auto alignment = [&](int column) { return model.index(0, column).data(Qt::TextAlignmentRole).toInt(); };
    EXPECT_TRUE(alignment(CausticTableModel::Memory) & Qt::AlignRight);
    EXPECT_TRUE(alignment(CausticTableModel::Surface) & Qt::AlignLeft);
}

TEST(CausticTable, ANewSolutionLeavesRowsWhereTheyAre) {
    CausticTableModel model;
    CausticFilter filter;
    filter.setSourceModel(&model);
    filter.sort(CausticTableModel::InTextures, Qt::DescendingOrder);
    QItemSelectionModel selection(&filter);
    const auto row = [](std::uint32_t node, double lumen) { return row_of(node, "S", Decision::Texture, lumen); };
    model.set_rows({row(1, 10), row(3, 30), row(5, 50)});
    const QPersistentModelIndex third = model.index(1, 0);
    selection.select(filter.mapFromSource(third), QItemSelectionModel::Select | QItemSelectionModel::Rows);
    QSignalSpy resets(&model, &QAbstractItemModel::modelReset);
    QSignalSpy changes(&model, &QAbstractItemModel::dataChanged);
    // Two come, one goes, one changes its light and so its place in the sorted view.
    model.set_rows({row(2, 20), row(3, 99), row(4, 40), row(5, 50)});
    ASSERT_EQ(model.rowCount(), 4);
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(model.row(i).record.node.slot, std::uint32_t(i) + 2);
    }
    EXPECT_EQ(resets.count(), 0);
    EXPECT_EQ(changes.count(), 1) << "what is the same is not told";
    EXPECT_EQ(third.row(), 1);
    ASSERT_EQ(selection.selectedRows().size(), 1);
    EXPECT_EQ(filter.mapToSource(selection.selectedRows().first()).row(), 1);
    EXPECT_EQ(filter.mapToSource(filter.index(0, 0)).row(), 1) << "brightest first";
    model.set_rows({});
    EXPECT_EQ(model.rowCount(), 0);
}

TEST(CausticTable, ThousandsOfRowsTakeNoTime) {
    CausticTableModel model;
    CausticFilter filter;
    filter.setSourceModel(&model);
    filter.sort(CausticTableModel::InTextures, Qt::DescendingOrder);
    QTableView view;
    view.setModel(&filter);
    view.show();
    QElapsedTimer clock;
    for (int round = 0; round < 3; ++round) {
        std::vector<CausticRow> rows;
        for (std::uint32_t i = 0; i < 3000; ++i) {
            rows.push_back(
                row_of(i, "Surface", Decision::Texture, double((i * 7919U + std::uint32_t(round) * 13U) % 1000U)));
        }
        QSignalSpy changes(&model, &QAbstractItemModel::dataChanged);
        clock.restart();
        model.set_rows(std::move(rows));
        std::printf("[ stall    ] 3000 rows, light number %d: %.1f ms\n", round + 1, double(clock.nsecsElapsed()) / 1e6);
        EXPECT_EQ(changes.count(), round == 0 ? 0 : 1);
        EXPECT_EQ(filter.rowCount(), 3000);
        EXPECT_GE(
            filter.index(0, 0).siblingAtColumn(CausticTableModel::InTextures).data(CausticTableModel::kSortRole).toDouble(),
            998.0);
    }
}

TEST(CausticPictures, AreTheTexturesUprightAndHalvedByMeans) {
    auto texture = std::make_shared<CausticTexture>();
    texture->width = 128;
    texture->height = 2;
    texture->high = vec2(1.0F);
    texture->image.assign(256, Rgb(0.0F));
    texture->image[0] = Rgb(100.0F); // low corner: lower left in a picture
    const auto made = make_texture_pictures({texture});
    ASSERT_EQ(made.size(), 1U);
    ASSERT_EQ(made[0].levels.size(), 2U);
    const QImage& whole = made[0].levels[0];
    EXPECT_EQ(whole.size(), QSize(128, 2));
    EXPECT_GT(qGray(whole.pixel(0, 1)), 200);
    EXPECT_EQ(qGray(whole.pixel(0, 0)), 0);
    const QImage& half = made[0].levels[1];
    EXPECT_EQ(half.size(), QSize(64, 1));
    EXPECT_GT(qGray(half.pixel(0, 0)), 0);
    EXPECT_LT(qGray(half.pixel(0, 0)), qGray(whole.pixel(0, 1)));
}

class CausticInspector : public WindowTest {
protected:
    void open_and_light(const QString& path) {
        QSignalSpy opened(&window->files(), &FileController::opened);
        window->files().open(path);
        ASSERT_TRUE(opened.count() > 0 || opened.wait(20000));
        SolverSettings draft;
        draft.quality = SolverSettings::Quality::Draft;
        ASSERT_TRUE(window->document().apply({SetSolverSettings{draft}}, QStringLiteral("Draft")));
        window->document().undo_stack()->clear();
        ASSERT_TRUE(wait_for_light());
    }
    [[nodiscard]] bool wait_for_light() {
        return QTest::qWaitFor(
            [&] {
                const auto solution = window->engine().solution();
                return solution && solution->final && solution->revision >= window->document().revision();
            },
            90000);
    }
    void open_panel() {
        trigger(ActionId::InspectCaustics);
        settle();
        ASSERT_TRUE(window->findChild<QDockWidget*>(QStringLiteral("dock_caustics"))->isVisible());
    }
    template <class T> T* part(const char* name) {
        T* found = window->caustics().findChild<T*>(QLatin1StringView(name));
        EXPECT_NE(found, nullptr) << name;
        return found;
    }
    QTableView& table() { return *window->caustics().table(); }
    void click_row(int row) {
        const QRect rect = table().visualRect(table().model()->index(row, 0));
        QTest::mouseClick(table().viewport(), Qt::LeftButton, {}, rect.center());
        settle();
    }
    /// The solution's record of a node's first side and chart.
    [[nodiscard]] CausticRecord record_of(NodeId node) {
        for (const CausticRecord& r : window->engine().solution()->caustic_records) {
            if (r.node == node) {
                return r;
            }
        }
        ADD_FAILURE() << "no record";
        return {};
    }
};

TEST_F(CausticInspector, SaysWhyThereIsNothingInARoomWithoutGlass) {
    Scene matt;
    Node node;
    node.name = "Box";
    node.shape = matt.shapes.insert(Shape{"Box", Box{vec3(1.0F)}, {}});
    node.materials = {matt.materials.insert(Material{})};
    matt.roots.push_back(matt.nodes.insert(node));
    Node lamp;
    lamp.light = matt.lights.insert(Light{});
    lamp.transform.translation.y = 2.0;
    matt.roots.push_back(matt.nodes.insert(lamp));
    const QString path = folder.filePath(QStringLiteral("matt.glb"));
    ASSERT_TRUE(write_scene(path.toStdString(), matt));
    open_and_light(path);
    open_panel();
    auto* nothing = part<QLabel>("caustic_nothing");
    ASSERT_TRUE(QTest::qWaitFor([&] { return nothing->isVisible(); }, 5000));
    EXPECT_TRUE(nothing->text().contains(QStringLiteral("There is no specular surface in the scene.")))
        << nothing->text().toStdString();
    EXPECT_FALSE(table().isVisible());
}

TEST_F(CausticInspector, RowsSelectAndFrameAndCanBeSetByHand) {
    open_and_light(QStringLiteral(ATRIUM_SOURCE_DIR "/scenes/glass-ball/glass-ball.glb"));
    open_panel();
    const NodeId board = named("Table");
    const NodeId ball = named("Ball");
    ASSERT_TRUE(QTest::qWaitFor([&] { return window->caustics().view_row(board) >= 0; }, 5000));
    EXPECT_TRUE(table().hasFocus()) << "keys work at once";
    EXPECT_GT(part<QLabel>("caustic_summary")->text().size(), 20);

    // A click selects the node; the view stays.
    window->document().selection()->clear();
    const dmat4 before = window->viewport().camera().to_world;
    click_row(window->caustics().view_row(board));
    EXPECT_EQ(window->document().selection()->nodes(), std::vector<NodeId>{board});
    EXPECT_TRUE(window->tree().view()->selectionModel()->isSelected(window->tree().view_index(board)));
    EXPECT_EQ(window->viewport().camera().to_world, before);
    // Return frames the surface.
    QTest::keyClick(&table(), Qt::Key_Return);
    settle();
    const dmat4 framed = window->viewport().camera().to_world;
    EXPECT_NE(framed, before);
    const PiecePlace place = piece_place(scene(), *window->engine().solution(), *window->caustics().current());
    const DBox3& piece = place.bounds;
    ASSERT_FALSE(piece.empty());
    EXPECT_NEAR(place.normal.y, 1.0, 1e-3) << "the board is lit from above";
    EXPECT_TRUE(piece.max.x > place.focus.x && place.focus.x > piece.min.x);
    EXPECT_GT(dvec3(framed[3]).y, piece.max.y);
    EXPECT_LT((at(place.focus) - window->viewport().rect().center()).manhattanLength(), 5);
    EXPECT_NEAR(piece.size().x, scene().world_bounds(board).size().x, 0.02);
    for (const dvec3& corner : {piece.min, piece.max}) {
        const QPoint p = at(corner);
        EXPECT_TRUE(window->viewport().rect().contains(p)) << p.x() << ", " << p.y();
    }
    // From below, where it cannot be seen, the view goes round to the lit side.
    window->viewport().set_camera(
        {glm::inverse(glm::lookAt(dvec3(0.2, -1.0, 0.3), dvec3(0.0), dvec3(0, 1, 0))), window->viewport().camera().lens});
    QTest::keyClick(&table(), Qt::Key_Return);
    settle();
    EXPECT_GT(dvec3(window->viewport().camera().to_world[3]).y, piece.max.y);
    window->viewport().set_camera({before, window->viewport().camera().lens});
    const QRect cell = table().visualRect(table().model()->index(window->caustics().view_row(board), 0));
    QTest::mouseDClick(table().viewport(), Qt::LeftButton, {}, cell.center());
    EXPECT_EQ(window->viewport().camera().to_world, framed) << "so does a double click";

    // Selecting elsewhere marks the row; what has none leaves it.
    table().clearSelection();
    window->document().selection()->set({ball});
    window->document().selection()->set({board});
    EXPECT_TRUE(table().selectionModel()->isRowSelected(window->caustics().view_row(board), {}));

    // The picture of the texture.
    CausticPreview& preview = *window->caustics().preview();
    ASSERT_TRUE(QTest::qWaitFor([&] { return preview.ready(); }, 10000));
    const CausticRecord automatic = record_of(board);
    ASSERT_EQ(automatic.decision, Decision::Texture);
    ASSERT_FALSE(automatic.boxes.empty());
    auto* boxes = part<QTableWidget>("caustic_boxes");
    EXPECT_EQ(boxes->rowCount(), int(automatic.boxes.size()));
    const double fitted = preview.zoom();
    const QPointF middle(0.5 * preview.width(), 0.5 * preview.height());
    const QPointF held = preview.piece_at(middle);
    QWheelEvent wheel(middle, preview.mapToGlobal(middle), {}, {0, 480}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&preview, &wheel);
    EXPECT_GT(preview.zoom(), 2.0 * fitted);
    EXPECT_NEAR(preview.piece_at(middle).x(), held.x(), 1e-6) << "what is under the cursor stays there";
    preview.fit_boxes();
    EXPECT_NEAR(preview.zoom(), fitted, 1e-6);

    // Mesh by hand: an edit that light follows, with its word in the table, and undo.
    const Scene untouched = scene();
    QSignalSpy resets(&window->caustics().model(), &QAbstractItemModel::modelReset);
    auto* show = part<QComboBox>("caustic_show");
    show->setCurrentIndex(int(CausticWish::Show::Mesh));
    Q_EMIT show->activated(show->currentIndex());
    EXPECT_EQ(node(board).caustics.show, CausticWish::Show::Mesh);
    EXPECT_EQ(entries(), 1);
    QElapsedTimer clock;
    clock.start();
    ASSERT_TRUE(wait_for_light());
    std::printf("[ follow   ] caustics set to the mesh: light after %lld ms\n", static_cast<long long>(clock.elapsed()));
    settle();
    EXPECT_EQ(record_of(board).decision, Decision::SetToMesh);
    EXPECT_EQ(window->caustics().current()->record.decision, Decision::SetToMesh) << "the row stayed chosen";
    EXPECT_TRUE(table().selectionModel()->isRowSelected(window->caustics().view_row(board), {}));
    EXPECT_TRUE(part<QLabel>("caustic_head")->text().contains(QStringLiteral("Mesh (by hand)")));
    EXPECT_EQ(resets.count(), 0);
    EXPECT_FALSE(boxes->isVisible());
    trigger(ActionId::Undo);
    EXPECT_EQ(scene(), untouched);
    ASSERT_TRUE(wait_for_light());
    EXPECT_EQ(record_of(board), automatic) << "to the last bit";

    // Texels by hand, in millimetres; an empty field is automatic again.
    show->setCurrentIndex(int(CausticWish::Show::Texture));
    Q_EMIT show->activated(show->currentIndex());
    NumberField* texel = part<NumberField>("Texel size");
    EXPECT_TRUE(texel->text().isEmpty());
    EXPECT_TRUE(texel->placeholderText().contains(QStringLiteral("automatic")));
    type(texel, "4");
    EXPECT_FLOAT_EQ(node(board).caustics.texel, 0.004F);
    ASSERT_TRUE(wait_for_light());
    settle();
    EXPECT_EQ(record_of(board).sizing, CausticRecord::Sizing::ByHand);
    EXPECT_NEAR(window->caustics().current()->texel(), 0.004, 0.0001);
    type(texel, "");
    QTest::keyClick(texel, Qt::Key_Backspace);
    QTest::keyClick(texel, Qt::Key_Return);
    EXPECT_EQ(node(board).caustics.texel, 0.0F);
    EXPECT_EQ(entries(), 3);
    auto* reset = part<QPushButton>("caustic_reset");
    EXPECT_TRUE(reset->isEnabled());
    reset->click();
    settle();
    EXPECT_TRUE(node(board).caustics.automatic());
    EXPECT_FALSE(reset->isEnabled());
    while (window->document().undo_stack()->canUndo()) {
        trigger(ActionId::Undo);
    }
    EXPECT_EQ(scene(), untouched);
}

} // namespace
} // namespace atrium::ui
