// The filter's parameters, in MeshLab's words and in Roundel's.

#ifndef ROUNDEL_MESHLAB_PARAMETERS_HPP
#define ROUNDEL_MESHLAB_PARAMETERS_HPP

#include <common/interfaces.h>

#include <roundel/roundel.hpp>

/// Adds what the dialog asks for, with the defaults of `roundel quad`.
void declare_parameters(const MeshModel& mesh, RichParameterList& list);

/// What the dialog, or a script, says; `solve` is set. Throws std::invalid_argument for a choice
/// that there is not and for text that is no option; all else the library checks.
roundel::QuadOptions quad_options(const MeshModel& mesh, const RichParameterList& list);

#endif // ROUNDEL_MESHLAB_PARAMETERS_HPP
