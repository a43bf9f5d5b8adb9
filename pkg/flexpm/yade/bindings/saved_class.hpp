// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  How a scene that another build has saved is known before anything of flexpm in it is read.
/// Boost saves a number with each class, and nothing about its members: a scene that is read as other members is another scene,
/// or an error of the stream. All classes of flexpm stand in scenes with the number of the state, which rises with any change of
/// what one of them saves: tests/yade/saved_state.txt lists it.
#pragma once

#include <flexpm/yade/bindings/assembly_archive.hpp>

#include <new>
#include <stdexcept>
#include <string>

namespace flexpm_bindings {

/// @throws std::runtime_error  if a class stands in a scene with another number than it is saved with
inline void requireSavedVersion(const char* name, unsigned version)
{
	constexpr unsigned here = boost::serialization::assemblyVersion;
	if (version != here) {
		throw std::runtime_error(
		        std::string("scene = ") + name + " of state " + std::to_string(version) + ", must be " + std::to_string(here)
		        + ": another build of flexpm saved it; run it again, or load it with that build");
	}
}

} // namespace flexpm_bindings

/// REGISTER_SERIALIZABLE() for all classes of flexpm: in namespace yade, after the class.
#define REGISTER_SAVED(name)                                                                                                                                   \
	template <class Archive> void load_construct_data(Archive&, name* place, unsigned version)                                                             \
	{                                                                                                                                                      \
		flexpm_bindings::requireSavedVersion(#name, version);                                                                                          \
		::new (place) name();                                                                                                                          \
	}                                                                                                                                                      \
	REGISTER_SERIALIZABLE(name);                                                                                                                           \
	}                                                                                                                                                      \
	BOOST_CLASS_VERSION(yade::name, boost::serialization::assemblyVersion)                                                                                 \
	namespace yade {
