// The filter's action: it quadrangulates the current layer and reports faults.

#include "action.hpp"

#include "layer.hpp"
#include "parameters.hpp"
#include "progress.hpp"

#include <roundel/roundel.hpp>
#include <roundel/vcg.hpp>

#include <stdexcept>
#include <string>

namespace {

/// A line about the quads and their faults.
std::string summary(const roundel::Quads& quads) {
    const auto count = [](std::size_t number, const char* what) {
        return std::to_string(number) + what;
    };
    std::string text =
        count(quads.size(), " quads, ") + count(quads.irregular_count(), " irregular vertices");
    if (!quads.others().empty()) {
        text += count(quads.others().size(), " faces that are not quads").insert(0, ", ");
    }
    if (!quads.conforming()) {
        const auto faults = quads.faults();
        text += "; they do not conform: " + count(faults.faces.size(), " faces, ") +
                count(faults.edges.size(), " edges and ") +
                count(faults.vertices.size(), " vertices are at fault");
    }
    return text;
}

} // namespace

QString action::name() {
    return "Remeshing: Mixed-Integer Quadrangulation (Roundel)";
}

QString action::description() {
    return "Turns the triangles of the current layer into quads, in a new layer: a cross field, a "
           "seamless map that follows it, and the quads of the map's integer lines. Features "
           "become chains of edges.<br>See: <br /><i>David Bommes, Henrik Zimmer, Leif "
           "Kobbelt</i><br/><b>\"Mixed-Integer Quadrangulation\"</b><br/>ACM Transactions on "
           "Graphics 28(3), 2009.";
}

QString action::run(MeshDocument& document, const RichParameterList& list,
                    vcg::CallBackPos* callback) {
    const MeshModel& mesh = *document.mm();
    Progress progress(callback);
    auto options = quad_options(mesh, list);
    options.solve->on_event = [&](const roundel::Event& event) { return progress.tell(event); };
    roundel::Quads quads;
    try {
        quads = roundel::quadrangulate(mesh.cm, options);
    } catch (const roundel::Error&) {
        if (!progress.is_cancelled()) {
            throw;
        }
    }
    if (progress.is_cancelled()) {
        throw std::runtime_error("cancelled");
    }
    add_layer(document, quads);
    return QString::fromStdString(summary(quads));
}
