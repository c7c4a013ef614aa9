// Renders the present view to a picture file, with progress and cancel; the window stays usable meanwhile.
#pragma once

#include "engine/view/still.h"

#include <QDialog>
#include <QImage>
#include <QTimer>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

class QCheckBox;
class QLabel;
class QProgressBar;
class QPushButton;

namespace atrium::ui {

class NumberField;

/// UI thread only. Keeps its own copy of scene, solution and camera, so later edits do not reach the picture.
class ExportPictureDialog : public QDialog {
    Q_OBJECT
public:
    /// `exposure` in stops over automatic exposure, for PNG; EXR is linear cd/m2. `shares` of the light, as in the view.
    /// With a `scale` PNG is in false colour, with its legend.
    ExportPictureDialog(Scene scene, std::shared_ptr<const Solution> solution, ViewCamera camera, float exposure,
                        const LightShares& shares, const std::optional<FalseColor>& scale, const QString& suggestion,
                        QWidget* parent);
    ~ExportPictureDialog() override;
    void render(const QString& path); ///< with the settings shown; closes the dialog when the file is written

Q_SIGNALS:
    void message(const QString& text);

private:
    /// The newest picture of a final pass, small and as it is shown; written by the pool, read by the timer.
    struct Preview {
        std::mutex mutex;
        QImage image;
    };
    void choose_file();
    void show_progress();
    Scene scene_;
    std::shared_ptr<const Solution> solution_;
    ViewCamera camera_;
    float exposure_;
    LightShares shares_;
    std::optional<FalseColor> scale_;
    QString suggestion_;
    NumberField* width_ = nullptr;
    NumberField* height_ = nullptr;
    NumberField* samples_ = nullptr;
    QCheckBox* final_ = nullptr;
    NumberField* final_samples_ = nullptr;
    QCheckBox* channels_ = nullptr;
    QLabel* preview_ = nullptr; ///< of a final pass in the making
    QProgressBar* bar_ = nullptr;
    QLabel* error_ = nullptr;
    QPushButton* start_ = nullptr;
    QTimer poll_;
    StopFlag stop_;
    std::shared_ptr<std::atomic<double>> fraction_;
    std::shared_ptr<Preview> newest_;
    bool running_ = false;
};

} // namespace atrium::ui
