/* Stands in for bcryptprimitives.dll, which Wine 8 lacks: Rust seeds its hash maps from it. */
#include <ntsecapi.h>
#include <stddef.h>
#include <windows.h>

__declspec(dllexport) BOOL WINAPI ProcessPrng(BYTE* bytes, SIZE_T count) {
    return RtlGenRandom(bytes, (ULONG)count);
}
