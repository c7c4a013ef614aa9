// The list of keys, the about box and the search for a command; all non-modal or window-modal, none blocks.
#pragma once

class QWidget;

namespace atrium::ui {

class Actions;

void show_shortcut_list(QWidget* parent);
void show_about_box(QWidget* parent);
void show_command_search(const Actions& actions, QWidget* parent);

} // namespace atrium::ui
