/// What the original's classes are exported with. Everything here is in headers: nothing.

#ifndef COMISO_CONFIG_COMISODEFINES_HH
#define COMISO_CONFIG_COMISODEFINES_HH

#ifndef COMISODLLEXPORT
#define COMISODLLEXPORT
#endif

#ifndef COMISODLLEXPORTONLY
#define COMISODLLEXPORTONLY
#endif

#endif // COMISO_CONFIG_COMISODEFINES_HH
