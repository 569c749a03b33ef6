// The plugin of MeshLab 2020.09, whose failures are values.

#include "filter_2020.hpp"

#include "action.hpp"
#include "parameters.hpp"

#include <QAction>

#include <exception>

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
    return action::name();
}

QString RoundelFilter::filterInfo(FilterIDType) const {
    return action::description();
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

bool RoundelFilter::applyFilter(QAction*, MeshDocument& document, const RichParameterList& list,
                                vcg::CallBackPos* callback) {
    try {
        Log(GLLogStream::FILTER, qUtf8Printable(action::run(document, list, callback)));
        return true;
    } catch (const std::exception& error) {
        errorMessage = QString::fromUtf8(error.what());
        Log(GLLogStream::WARNING, qUtf8Printable("Roundel: " + errorMessage));
        return false;
    }
}
