#pragma once

#include <string>
#include <vector>

#include "serve/certificate.h"

namespace mimicry::serve {

/// The self-signed certificate of the data folder; one that is damaged, about to end or not for all
/// these addresses is made again. Its file can be read by its owner alone from the first moment on.
/// Not where other threads write files. Throws Error(io) where folder or file cannot be written.
Certificate kept_certificate(const std::string& data_folder,
                             const std::vector<std::string>& addresses);

}  // namespace mimicry::serve
