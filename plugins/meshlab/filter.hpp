// The filter as MeshLab 2020.09 knows it: a plugin with one action.

#ifndef ROUNDEL_MESHLAB_FILTER_HPP
#define ROUNDEL_MESHLAB_FILTER_HPP

#include <common/interfaces.h>

#include <QString>

/// Turns the current layer's triangles into quads, in a layer of their own.
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
    bool applyFilter(QAction* action, MeshDocument& document, const RichParameterList& list,
                     vcg::CallBackPos* callback) override;

  private:
    /// Tells the user why there are no quads: in the dialog, and in the log, which is all that
    /// meshlabserver prints.
    bool failed(const QString& why);
};

#endif // ROUNDEL_MESHLAB_FILTER_HPP
