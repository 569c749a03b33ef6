// The filter's action: it quadrangulates the current layer and reports faults.

#include "filter.hpp"

#include "layer.hpp"
#include "parameters.hpp"
#include "progress.hpp"

#include <roundel/roundel.hpp>
#include <roundel/vcg.hpp>

#include <QAction>

#include <algorithm>
#include <exception>
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

RoundelFilter::RoundelFilter() {
    typeList << quadrangulate;
    for (const FilterIDType type : types()) {
        actionList << new QAction(filterName(type), this);
    }
}

QString RoundelFilter::pluginName() const {
    return "FilterRoundel";
}

QString RoundelFilter::filterName(FilterIDType) const {
    return "Remeshing: Mixed-Integer Quadrangulation (Roundel)";
}

QString RoundelFilter::filterInfo(FilterIDType) const {
    return "Turns the triangles of the current layer into quads, in a new layer: a cross field, a "
           "seamless map that follows it, and the quads of the map's integer lines. Features "
           "become "
           "chains of edges.<br>See: <br /><i>David Bommes, Henrik Zimmer, Leif Kobbelt</i><br/>"
           "<b>\"Mixed-Integer Quadrangulation\"</b><br/>ACM Transactions on Graphics 28(3), 2009.";
}

MeshFilterInterface::FilterClass RoundelFilter::getClass(QAction*) {
    return FilterClass(Remeshing | Polygonal);
}

MeshFilterInterface::FILTER_ARITY RoundelFilter::filterArity(QAction*) const {
    return SINGLE_MESH;
}

int RoundelFilter::getPreConditions(QAction*) const {
    return MeshModel::MM_FACENUMBER;
}

int RoundelFilter::postCondition(QAction*) const {
    return MeshModel::MM_NONE;
}

void RoundelFilter::initParameterSet(QAction*, MeshModel& mesh, RichParameterList& list) {
    declare_parameters(mesh, list);
}

bool RoundelFilter::failed(const QString& why) {
    errorMessage = why;
    Log(GLLogStream::WARNING, qUtf8Printable("Roundel: " + why));
    return false;
}

bool RoundelFilter::applyFilter(QAction*, MeshDocument& document, const RichParameterList& list,
                                vcg::CallBackPos* callback) {
    const MeshModel& mesh = *document.mm();
    Progress progress(callback);
    try {
        auto options = quad_options(mesh, list);
        options.solve->on_event = [&](const roundel::Event& event) { return progress.tell(event); };
        const auto quads = roundel::quadrangulate(mesh.cm, options);
        if (progress.is_cancelled()) {
            return failed("cancelled");
        }
        add_layer(document, quads);
        Log(GLLogStream::FILTER, qUtf8Printable(QString::fromStdString(summary(quads))));
        return true;
    } catch (const std::exception& error) {
        return failed(progress.is_cancelled() ? QString("cancelled")
                                              : QString::fromUtf8(error.what()));
    }
}
