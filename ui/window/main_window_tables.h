// Commands that come in rows of one kind, shared by the files that fill menus and those that connect them.
#pragma once

#include "ui/actions/actions.h"
#include "ui/actions/edit_controller.h"
#include "ui/viewport/viewport_widget.h"

#include <utility>

namespace atrium::ui {

inline constexpr std::pair<ActionId, ToolKind> kTools[] = {{ActionId::ToolSelect, ToolKind::Select},
                                                           {ActionId::ToolMove, ToolKind::Move},
                                                           {ActionId::ToolRotate, ToolKind::Rotate},
                                                           {ActionId::ToolScale, ToolKind::Scale},
                                                           {ActionId::ToolMeasure, ToolKind::Measure}};

inline constexpr std::pair<ActionId, NewObject> kAdd[] = {{ActionId::AddPolygon, NewObject::Polygon},
                                                          {ActionId::AddBox, NewObject::Box},
                                                          {ActionId::AddSphere, NewObject::Sphere},
                                                          {ActionId::AddCylinder, NewObject::Cylinder},
                                                          {ActionId::AddCone, NewObject::Cone},
                                                          {ActionId::AddDisc, NewObject::Disc},
                                                          {ActionId::AddPointLight, NewObject::PointLight},
                                                          {ActionId::AddSpotLight, NewObject::SpotLight},
                                                          {ActionId::AddSun, NewObject::Sun},
                                                          {ActionId::AddAreaLight, NewObject::AreaLight}};

inline constexpr std::pair<ActionId, CausticView> kWays[] = {{ActionId::CausticsFlat, CausticView::Flat},
                                                             {ActionId::CausticsOnMesh, CausticView::Mesh},
                                                             {ActionId::CausticsInTextures, CausticView::Texture},
                                                             {ActionId::CausticsWhole, CausticView::Whole}};

} // namespace atrium::ui
