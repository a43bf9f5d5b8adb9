// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/grains/GlScale.hpp>

#include <GL/glut.h>

#include <algorithm>
#include <cstdio>

namespace yade {

namespace {

	constexpr int boxes = 64, numbers = 5, mostKinds = 8;

} // namespace

GlScale::GlScale(const flexpm::Extent& specimen, const Vector3r& textColor_)
        : left(specimen.high.x)
        , bottom(specimen.low.y)
        , height(specimen.high.y - specimen.low.y)
        , textColor(textColor_)
{
	width = .05 * height;
	left += width; // a gap as wide as the scale
}

void GlScale::draw(flexpm::GrainValue what, flexpm::ValueRange range) const
{
	if (flexpm::is_kind(what))
		kinds(range);
	else
		colours(what, range);
	text(1.04, flexpm::scale_title(what));
}

void GlScale::colours(flexpm::GrainValue what, flexpm::ValueRange range) const
{
	for (int i = 0; i < boxes; ++i)
		box(Real(i) / boxes, Real(i + 1) / boxes, flexpm::colour_of((i + .5) / boxes, { 0., 1. }));
	for (int i = 0; i < numbers; ++i) {
		const Real share = Real(i) / (numbers - 1);
		char       line[32];
		std::snprintf(line, sizeof(line), "%.4g", flexpm::scale_factor(what) * (range.low + share * (range.high - range.low)));
		text(.97 * share, line); // the highest number stays below the title
	}
}

void GlScale::kinds(flexpm::ValueRange range) const
{
	for (int number = 0; number <= std::min(int(range.high), mostKinds - 1); ++number) {
		const Real low = 1. - (number + 1.) / mostKinds;
		box(low, low + .6 / mostKinds, flexpm::colour_of_kind(number));
		text(low + .15 / mostKinds, std::to_string(number));
	}
}

void GlScale::box(Real from, Real to, flexpm::Colour colour) const
{
	glColor3d(colour.red, colour.green, colour.blue);
	glBegin(GL_QUADS);
	glVertex3d(left, bottom + from * height, 0.);
	glVertex3d(left + width, bottom + from * height, 0.);
	glVertex3d(left + width, bottom + to * height, 0.);
	glVertex3d(left, bottom + to * height, 0.);
	glEnd();
}

void GlScale::text(Real share, const string& line) const
{
	glColor3d(textColor[0], textColor[1], textColor[2]);
	glRasterPos3d(share > 1. ? left : left + 1.3 * width, bottom + share * height, 0.);
	for (char one : line)
		glutBitmapCharacter(GLUT_BITMAP_HELVETICA_18, one);
}

} // namespace yade
