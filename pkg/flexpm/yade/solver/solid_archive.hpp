// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  How Boost saves the state of a solid: all members that flexpm::visit_members names.
#pragma once

#include <flexpm/kernel/solids/solid_state.hpp>
#include <flexpm/yade/bindings/assembly_archive.hpp>

namespace boost {
namespace serialization {

	template <class Archive> void serialize(Archive& archive, flexpm::Tetrahedra& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::FaceGroup& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::FaceCrack& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::FaceContacts& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::SurfaceTriangles& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::RigidBody& part, unsigned) { archiveMembers(archive, part); }
	template <class Archive> void serialize(Archive& archive, flexpm::SolidState& part, unsigned) { archiveMembers(archive, part); }

} // namespace serialization
} // namespace boost
