// Adds quads to a MeshLab document.

#ifndef ROUNDEL_MESHLAB_LAYER_HPP
#define ROUNDEL_MESHLAB_LAYER_HPP

#include "meshlab.hpp"

#include <roundel/roundel.hpp>

/// Adds the quads to the document as its current layer: pairs of triangles whose common edge is
/// faux, with one normal for each quad. The layer has the name and the placement of the layer that
/// was current.
void add_layer(MeshDocument& document, const roundel::Quads& quads);

#endif // ROUNDEL_MESHLAB_LAYER_HPP
