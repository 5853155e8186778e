#include "capture/facades/drawn_facade.h"

namespace parvis::facades {

DrawnFacade::DrawnFacade(const PackedFacade& facade)
    : facade_(facade), model_(model_of(facade)), texels_(facade), chooser_(facade), drawn_(facade) {
  drawn_.blocks.clear();  // the texels hold them
}

ImageF DrawnFacade::view(const View& view, const ItemBuffer& seen) {
  const ViewChoice choice = chooser_.choice(glm::vec3(view.centre), float(1.0 / view.fx));
  drawn_.lists = choice.lists, drawn_.candidates = facade_.candidates;
  drawn_.candidates.insert(drawn_.candidates.end(), choice.candidates.begin(), choice.candidates.end());
  return view_of_facade(drawn_, texels_, view, seen, choice.triangles);
}

}  // namespace parvis::facades
