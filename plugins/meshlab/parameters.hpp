// The filter's parameters, in MeshLab's words and in Roundel's.

#ifndef ROUNDEL_MESHLAB_PARAMETERS_HPP
#define ROUNDEL_MESHLAB_PARAMETERS_HPP

#include <common/interfaces.h>

#include <roundel/roundel.hpp>

/// Adds the parameters of the dialog, with the defaults of `roundel quad`.
void declare_parameters(const MeshModel& mesh, RichParameterList& list);

/// The options that the dialog, or a script, gives; `solve` is set. Throws std::invalid_argument
/// for an unknown choice or option; the library checks everything else.
roundel::QuadOptions quad_options(const MeshModel& mesh, const RichParameterList& list);

#endif // ROUNDEL_MESHLAB_PARAMETERS_HPP
