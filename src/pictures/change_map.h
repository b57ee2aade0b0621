#pragma once
/// A frame minus another one of its run, as a map: what has changed of its grains, and which contacts it has
/// gained and lost.

#include "pictures/layers.h"

namespace talus::pictures {

/// Whose change is shown where these layers are: of the first of them that gives each grain a number; gamma
/// where they show what follows from it; else the displacement of grains. Maps of motion are a change
/// already.
MapKind changing_kind(const MapLayers& layers);

/// Two of them. The first: the changing_kind of the layers of the settings, of each free grain, its value in
/// the frame minus that in its reference, on a scale about 0 half as long as that of the map, whatever range
/// the settings have; where that is logarithmic, the logarithm of their ratio, in powers of ten; a grain that
/// has no value in one of them is an outline. The second: contacts between centres, those gained as whole
/// lines, those lost as two stubs towards each other from where the two grains are in the frame. Without a
/// reference nothing has changed. `frame` and its reference are as the maps see them. Throws as make_layer.
std::vector<MapLayer> change_layers(const MapFrame& frame, const MapSettings& settings,
                                    const MapExtent& extent);

/// Their map. Throws as make_map, and Error(internal) where the frames have different numbers of grains.
render::FrameView make_change_map(const MapFrame& frame, const MapSettings& settings,
                                  const MapExtent& extent);

}  // namespace talus::pictures
