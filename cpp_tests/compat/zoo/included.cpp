// Programs use <iostream> and <cmath> without including them.

#include <CoMISo/Solver/MISolver.hh>

void streams_and_mathematics_come_along();

void streams_and_mathematics_come_along() {
    const double root = std::sqrt(16.0);
    if (std::abs(root - 4.0) > 1e-15) {
        std::cerr << "the root of 16 is " << root << '\n';
        std::exit(1);
    }
}
