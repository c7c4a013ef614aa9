#include "ui/window/export_picture_dialog.h"

#include "engine/io/image_file.h"
#include "engine/view/tone.h"
#include "ui/document/background.h"
#include "ui/document/engine_text.h"
#include "ui/panels/number_field.h"
#include "ui/viewport/legend.h"
#include "ui/window/settings.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr int kPreviewWidth = 400; // pixels
constexpr int kPreviewHeight = 300;

/// Paints the scale's legend at the right edge of a finished picture, as large as in the view.
void add_legend(Picture& picture, const FalseColor& scale, QFont font) {
    const double zoom = std::max(picture.height / 800.0, 0.5);
    const QImage legend = Legend(scale, font, QPalette(Qt::white)).image(zoom);
    const int left = picture.width - legend.width() - int(12.0 * zoom);
    const int top = (picture.height - legend.height()) / 2;
    for (int y = std::max(0, -top); y < legend.height() && top + y < picture.height; ++y) {
        for (int x = std::max(0, -left); x < legend.width() && left + x < picture.width; ++x) {
            const QColor ink = legend.pixelColor(x, y);
            vec3& pixel = picture.pixels[std::size_t(top + y) * std::size_t(picture.width) + std::size_t(left + x)];
            pixel = glm::mix(pixel, vec3(ink.redF(), ink.greenF(), ink.blueF()), ink.alphaF());
        }
    }
}

/// A picture as it is shown, at most as wide and high as given.
QImage small_image(const Picture& picture, float exposure, int width, int height) {
    const double zoom = std::min({1.0, double(width) / picture.width, double(height) / picture.height});
    QImage out(std::max(int(picture.width * zoom), 1), std::max(int(picture.height * zoom), 1), QImage::Format_RGB32);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            // Means over what falls into a pixel: single samples would show grain that the picture does not have.
            const int x0 = x * picture.width / out.width();
            const int x1 = std::max((x + 1) * picture.width / out.width(), x0 + 1);
            const int y0 = y * picture.height / out.height();
            const int y1 = std::max((y + 1) * picture.height / out.height(), y0 + 1);
            vec3 sum(0.0F);
            for (int v = y0; v < y1; ++v) {
                for (int u = x0; u < x1; ++u) {
                    sum += picture.pixels[std::size_t(v) * std::size_t(picture.width) + std::size_t(u)];
                }
            }
            const vec3 c = display_color(sum / float((x1 - x0) * (y1 - y0)), exposure) * 255.0F + 0.5F;
            out.setPixel(x, y, qRgb(int(c.r), int(c.g), int(c.b)));
        }
    }
    return out;
}

} // namespace

ExportPictureDialog::ExportPictureDialog(Scene scene, std::shared_ptr<const Solution> solution, ViewCamera camera,
                                         float exposure, const LightShares& shares, const std::optional<FalseColor>& scale,
                                         const QString& suggestion, QWidget* parent)
    : QDialog(parent), scene_(std::move(scene)), solution_(std::move(solution)), camera_(std::move(camera)),
      exposure_(exposure), shares_(shares), scale_(scale), suggestion_(suggestion),
      fraction_(std::make_shared<std::atomic<double>>(0.0)) {
    setWindowTitle(tr("Export Picture"));
    auto* layout = new QVBoxLayout(this);
    auto* form = new QFormLayout;
    const auto number = [&](const QString& label, double value, double minimum, double maximum, const QString& suffix) {
        auto* field = new NumberField(NumberFormat::plain(minimum, maximum, 0, suffix));
        field->set_value(value);
        field->setAccessibleName(label);
        auto* title = new QLabel(label);
        field->attach_label(title);
        form->addRow(title, field);
        return field;
    };
    width_ = number(tr("Width"), 1920, 16, 16384, tr(" px"));
    height_ = number(tr("Height"), 1080, 16, 16384, tr(" px"));
    samples_ = number(tr("Samples per pixel side"), 2, 1, 8, {});
    final_ = new QCheckBox(tr("Final pass: compute the light of every pixel"));
    final_->setToolTip(tr("Contacts, folds and small things become as sharp as the picture. Takes minutes."));
    final_->setEnabled(!scale_);
    form->addRow(final_);
    final_samples_ = number(tr("Samples per pixel"), 64, 1, 4096, {});
    final_samples_->setToolTip(tr("Rounded up to a power of two. Four times as many halve the grain."));
    final_samples_->setEnabled(false);
    channels_ = new QCheckBox(tr("Also write parts of the light, depth, normals and colours (EXR)"));
    form->addRow(channels_);
    connect(final_, &QCheckBox::toggled, this, [this](bool on) {
        final_samples_->setEnabled(on);
        samples_->setEnabled(!on);
    });
    layout->addLayout(form);
    auto* note = new QLabel(tr("PNG is shown as in the view; EXR holds linear values in cd/m\u00b2."));
    if (scale_) {
        note->setText(tr("PNG is in false colour as in the view, with its legend; EXR holds linear values in cd/m\u00b2."));
    }
    if (!(shares_ == LightShares{})) {
        note->setText(note->text() + QLatin1Char('\n') + tr("Light as in the view: only %1.").arg(shares_text(shares_)));
    }
    note->setEnabled(false);
    layout->addWidget(note);
    preview_ = new QLabel;
    preview_->setAlignment(Qt::AlignCenter);
    preview_->setAccessibleName(tr("Preview"));
    preview_->hide();
    layout->addWidget(preview_);
    bar_ = new QProgressBar;
    bar_->setRange(0, 1000);
    bar_->setEnabled(false);
    layout->addWidget(bar_);
    error_ = new QLabel;
    error_->setWordWrap(true);
    error_->hide();
    layout->addWidget(error_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
    start_ = buttons->addButton(tr("Render..."), QDialogButtonBox::AcceptRole);
    layout->addWidget(buttons);
    connect(buttons, &QDialogButtonBox::accepted, this, &ExportPictureDialog::choose_file);
    connect(buttons, &QDialogButtonBox::rejected, this, [this] {
        if (running_) {
            stop_.request_stop(); // the answer closes nothing: the settings stay for another try
        } else {
            reject();
        }
    });
    poll_.setInterval(100);
    connect(&poll_, &QTimer::timeout, this, &ExportPictureDialog::show_progress);
}

void ExportPictureDialog::show_progress() {
    bar_->setValue(int(fraction_->load() * 1000));
    QImage image;
    if (newest_) {
        const std::lock_guard lock(newest_->mutex);
        image.swap(newest_->image);
    }
    if (!image.isNull()) {
        preview_->setPixmap(QPixmap::fromImage(image));
        preview_->show();
    }
}

ExportPictureDialog::~ExportPictureDialog() { stop_.request_stop(); }

void ExportPictureDialog::choose_file() {
    if (running_) {
        return;
    }
    auto* dialog = new QFileDialog(this, tr("Export Picture"), suggestion_, tr("PNG picture (*.png);;OpenEXR (*.exr)"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setFileMode(QFileDialog::AnyFile);
    dialog->setDefaultSuffix(QStringLiteral("png"));
    dialog->selectFile(QFileInfo(suggestion_).fileName());
    connect(dialog, &QFileDialog::filterSelected, dialog, [dialog](const QString& filter) {
        dialog->setDefaultSuffix(filter.contains(QLatin1StringView("exr")) ? QStringLiteral("exr") : QStringLiteral("png"));
    });
    connect(dialog, &QFileDialog::fileSelected, this, &ExportPictureDialog::render);
    dialog->open();
}

void ExportPictureDialog::render(const QString& path) {
    StillOptions options;
    options.width = int(width_->value());
    options.height = int(height_->value());
    options.samples_per_axis = int(samples_->value());
    options.shares = shares_;
    options.final_pass = final_->isEnabled() && final_->isChecked();
    options.final_samples = int(final_samples_->value());
    const bool channels = channels_->isChecked();
    newest_ = std::make_shared<Preview>();
    RunContext context;
    stop_ = StopFlag();
    context.stop = stop_;
    *fraction_ = 0;
    context.on_progress = [fraction = fraction_](const Progress& progress) { fraction->store(progress.fraction); };
    running_ = true;
    start_->setEnabled(false);
    bar_->setEnabled(true);
    error_->hide();
    poll_.start();
    run_in_background(
        this,
        [scene = scene_, solution = solution_, camera = camera_, exposure = exposure_, scale = scale_, font = font(),
         options, channels, context, path, preview = newest_]() -> Result<bool> {
            const bool png = path.endsWith(QLatin1StringView(".png"), Qt::CaseInsensitive);
            const bool amounts = png && scale;
            const float factor = exposure_scale(solution->mean_radiance, exposure);
            Picture picture;
            std::vector<PictureChannel> parts;
            if (amounts) {
                picture = render_false_color(scene, *solution, camera, options, *scale, context);
            } else {
                const StillLayers layers =
                    render_layers(scene, *solution, camera, options, context, [&](const StillLayers& so_far) {
                        QImage image = small_image(so_far.beauty(), factor, kPreviewWidth, kPreviewHeight);
                        const std::lock_guard lock(preview->mutex);
                        preview->image = std::move(image);
                    });
                picture = layers.beauty();
                if (channels && !png) {
                    parts = layers.channels();
                }
            }
            if (context.should_stop()) {
                return false;
            }
            if (amounts) {
                add_legend(picture, *scale, font);
            } else if (png) {
                for (vec3& pixel : picture.pixels) {
                    pixel = display_color(pixel, factor);
                }
            }
            if (auto done = write_picture(std::filesystem::path(path.toStdU16String()), picture, parts); !done) {
                return tl::unexpected<Error>(done.error());
            }
            return true;
        },
        [this, path](const Result<bool>& done) {
            running_ = false;
            poll_.stop();
            start_->setEnabled(true);
            bar_->setValue(0);
            bar_->setEnabled(false);
            preview_->hide();
            if (!done) {
                error_->setText(error_message(done.error()));
                error_->show();
            } else if (*done) {
                Q_EMIT message(tr("Picture written to %1.").arg(path));
                accept();
            }
        });
}

} // namespace atrium::ui
