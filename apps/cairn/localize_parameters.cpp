// SPDX-License-Identifier: Apache-2.0
#include "localize_parameters.h"

#include <fmt/format.h>

#include "cairn/core/error.h"

namespace cairn::app {

void visit(LocalizeParameters& parameters, ParameterVisitor& visitor) {
  visit(parameters.sequence, visitor);
  visitor.parameter({"features", at_least(1, "feature per image"), "Most features taken of an image."},
                    parameters.features);
  visitor.parameter({"contrast", above(0, "a share of the grey range"),
                     "Weakest feature that SIFT takes; less gives more features of dim texture."},
                    parameters.contrast);
  visitor.parameter({"descriptor", any("a name"),
                     "Descriptor of the features; it has to be the map's, which it is if left out."},
                    parameters.descriptor);
  visit(parameters.localize, visitor);
}

void LocalizeParameters::validate(const MapInfo& map) const {
  check_ranges(*this);
  if (!descriptor.empty() && descriptor != map.descriptor.name)
    throw InputError({"descriptor", 0, fmt::format("{}, as the map has", map.descriptor.name), descriptor,
                      "Leave it out: images are described as the map is."});
}

}  // namespace cairn::app
