// What the filter does and says, apart from MeshLab's classes of plugins, which differ between
// versions.

#ifndef ROUNDEL_MESHLAB_ACTION_HPP
#define ROUNDEL_MESHLAB_ACTION_HPP

#include "meshlab.hpp"

#include <QString>

namespace action {

/// The name in the menu and in scripts.
QString name();

/// The text of the dialog.
QString description();

/// Adds the quads of the current layer as a new layer, and returns a line about them. Throws
/// std::exception, with what to tell the user, if there are none; then no layer is added.
QString run(MeshDocument& document, const RichParameterList& list, vcg::CallBackPos* callback);

} // namespace action

#endif // ROUNDEL_MESHLAB_ACTION_HPP
