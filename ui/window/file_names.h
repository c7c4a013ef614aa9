// Small things that files of the window share about paths.
#pragma once

#include <QString>

#include <filesystem>

namespace atrium::ui {

inline std::filesystem::path to_path(const QString& path) { return std::filesystem::path(path.toStdU16String()); }

inline bool is_project(const QString& path) { return path.endsWith(QLatin1StringView(".atrium"), Qt::CaseInsensitive); }

} // namespace atrium::ui
