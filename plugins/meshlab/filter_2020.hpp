// The filter as a plugin of MeshLab 2020.09 with one action.

#ifndef ROUNDEL_MESHLAB_FILTER_2020_HPP
#define ROUNDEL_MESHLAB_FILTER_2020_HPP

#include <common/interfaces.h>

#include <QString>

/// Quadrangulates the current layer into a new layer.
class RoundelFilter : public QObject, public MeshFilterInterface {
    Q_OBJECT
    MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
    Q_INTERFACES(MeshFilterInterface)

  public:
    enum { quadrangulate };

    RoundelFilter();

    QString pluginName() const override;
    QString filterName(FilterIDType filter) const override;
    QString filterInfo(FilterIDType filter) const override;
    FilterClass getClass(QAction* action) override;
    FILTER_ARITY filterArity(QAction* action) const override;
    int getPreConditions(QAction* action) const override;
    int postCondition(QAction* action) const override;
    void initParameterSet(QAction* action, MeshModel& mesh, RichParameterList& list) override;
    /// What fails is told in the dialog and in the log, the only one that meshlabserver prints.
    bool applyFilter(QAction* action, MeshDocument& document, const RichParameterList& list,
                     vcg::CallBackPos* callback) override;
};

#endif // ROUNDEL_MESHLAB_FILTER_2020_HPP
