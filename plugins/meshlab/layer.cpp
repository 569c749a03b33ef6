// Adds quads to a MeshLab document as a new layer.

#include "layer.hpp"

#include <roundel/vcg.hpp>

#include <vcg/complex/algorithms/update/bounding.h>
#include <vcg/complex/algorithms/update/normal.h>

void add_layer(MeshDocument& document, const roundel::Quads& quads) {
    const MeshModel& triangles = *document.mm();
    const auto placement = triangles.cm.Tr;
    MeshModel& layer = *document.addNewMesh("", triangles.label() + " quads", true);
    layer.cm.Tr = placement;
    roundel::store(quads, layer.cm);
    layer.updateDataMask(MeshModel::MM_POLYGONAL | MeshModel::MM_FACEFACETOPO |
                         MeshModel::MM_VERTNORMAL);
    vcg::tri::UpdateBounding<CMeshO>::Box(layer.cm);
    vcg::tri::UpdateNormal<CMeshO>::PerBitQuadFaceNormalized(layer.cm);
    vcg::tri::UpdateNormal<CMeshO>::PerVertexFromCurrentFaceNormal(layer.cm);
}
