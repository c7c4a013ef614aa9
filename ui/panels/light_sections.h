// Sections of the properties panel for lamps and cameras.
#pragma once

#include "ui/panels/section.h"

class QPushButton;

namespace atrium::ui {

class PhotometryBox;

/// Kind, colour, intensity with its unit, flux, photometry, cone, angular diameter.
class LightSection : public Section {
    Q_OBJECT
public:
    explicit LightSection(Document& document);

Q_SIGNALS:
    void choose_photometry(const std::vector<atrium::LightId>& lights);

protected:
    bool has_target() const override;
    void refresh_more() override;

private:
    std::vector<LightId> targets() const;
    /// A value of each lamp; nothing where one of them does not fit.
    std::vector<double> read_lamps(const std::function<bool(const Light&)>& fits,
                                   const std::function<double(const Light&)>& get) const;
    SceneEdit write(const std::function<void(Light&)>& change) const;
    NumberField* intensity_ = nullptr;
    PhotometryBox* photometry_ = nullptr;
};

/// Field of view and exposure; "Look through".
class CameraSection : public Section {
    Q_OBJECT
public:
    explicit CameraSection(Document& document);

Q_SIGNALS:
    void look_through(atrium::NodeId camera);

protected:
    bool has_target() const override;

private:
    std::vector<CameraId> targets() const;
    SceneEdit write(const std::function<void(Camera&)>& change) const;
};

} // namespace atrium::ui
