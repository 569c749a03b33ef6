// The headers of MeshLab's plugin interface, whatever its version.

#ifndef ROUNDEL_MESHLAB_MESHLAB_HPP
#define ROUNDEL_MESHLAB_MESHLAB_HPP

#ifdef ROUNDEL_MESHLAB_2020
#include <common/interfaces.h>
#else
#include <common/plugins/interfaces/filter_plugin.h>
#endif

#endif // ROUNDEL_MESHLAB_MESHLAB_HPP
