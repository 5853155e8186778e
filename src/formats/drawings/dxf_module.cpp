#include "formats/drawings/dxf_module.h"

PARVIS_MODULE(parvis::formats::DxfFunctions){parvis::formats::geometry_by_gdal, parvis::formats::dxf_by_gdal};
