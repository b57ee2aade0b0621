#pragma once
/// The change between two frames as a map: of a grain quantity, and contacts gained and lost.

#include "pictures/layers.h"

namespace talus::pictures {

/// Returns the map whose change is shown for these layers: the first one that gives each grain a number;
/// gamma if they show something derived from it; otherwise displacement. Maps of motion are a change.
MapKind changing_kind(const MapLayers& layers);

/// Returns two layers. The first shows, for each free grain, the value of changing_kind in the frame minus
/// that in its reference. Its scale is centred on 0 and half as long as that of the map, whatever range the
/// settings have. If that scale is logarithmic, the layer shows the logarithm of the ratio, in powers of ten.
/// A grain without a value in one of the frames is an outline. The second layer shows contacts between
/// centres: gained ones as complete lines, lost ones as two stubs towards each other at the current positions
/// of the two grains. Without a reference, nothing has changed. `frame` and its reference are as the maps see
/// them. Throws the errors of make_layer.
std::vector<MapLayer> change_layers(const analysis::GrainSource& frame, const MapSettings& settings,
                                    const MapExtent& extent);

/// Returns the map of these layers. Throws the errors of make_map, and Error(internal) if the frames have
/// different numbers of grains.
render::FrameView make_change_map(const analysis::GrainSource& frame, const MapSettings& settings,
                                  const MapExtent& extent);

}  // namespace talus::pictures
