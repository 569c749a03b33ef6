// Makes quads of a torus, by the C++ layer.
#include <roundel/roundel.hpp>

#include <iostream>

int main() {
    const auto mesh = roundel::Mesh::shape("torus", 500);
    const auto quads = roundel::quadrangulate(mesh, roundel::QuadOptions().set_quads(100));
    std::cout << quads.size() << " quads\n";
    return quads.size() > 50 ? 0 : 1;
}
