/// The export macro of CoMISo's classes. It is empty, because everything here is in headers.

#ifndef COMISO_CONFIG_COMISODEFINES_HH
#define COMISO_CONFIG_COMISODEFINES_HH

#ifndef COMISODLLEXPORT
#define COMISODLLEXPORT
#endif

#ifndef COMISODLLEXPORTONLY
#define COMISODLLEXPORTONLY
#endif

#endif // COMISO_CONFIG_COMISODEFINES_HH
