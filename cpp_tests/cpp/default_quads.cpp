// usage: default_quads_cpp MESH QUADS.obj OTHER.obj
//
// The quads that the C++ layer makes of a mesh when it is told nothing are those that the program
// wrote to QUADS.obj when it was told nothing: the same file when written to OTHER.obj.

#include "../c/same_bytes.h"

#include <roundel/roundel.hpp>

#include <cstdio>

int main(int count, char** argument) {
    CHECK(count == 4);
    const auto mesh = roundel::Mesh::read(argument[1]);
    const auto quads = roundel::quadrangulate(mesh);
    CHECK(quads.conforming());
    std::remove(argument[3]);
    quads.write(argument[3]);
    same_bytes(argument[2], argument[3]);
    return 0;
}
