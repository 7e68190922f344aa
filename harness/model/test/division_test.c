/* Where pieces of members begin and end, and which element is at a place. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/model/model.h"

enum { WHOLE, LOADED, OWN };

/* Three members in a row: without loads within, with some, with some and divisions of its own. */
static void row(scene *s)
{
    const double y[3] = {0, 1, 0};
    const section_spec spec = section_spec_rectangle(2e11, 8e10, 0.01, 0.01);
    scene_init(s, "row");
    scene_add_section(s, &spec);
    for (int i = 0; i < 4; i++)
        scene_add_node(s, i, 0, 0);
    for (int i = 0; i < 3; i++)
        scene_add_member(s, i, i + 1, 0, y);
    scene_member_at(s, OWN)->divisions = 3;
    scene_add_load(s, SCENE_FORCE, 1, 1, 0, 0);
    scene_add_load(s, SCENE_DISTRIBUTED, WHOLE, 1, 0, 0);
    scene_add_load_within(s, SCENE_MEMBER_FORCE, LOADED, 0.7, 1, 0, 0);
    scene_load *part = scene_load_at(s, scene_add_load(s, SCENE_DISTRIBUTED, LOADED, 1, 0, 0));
    part->range[0] = 0.2;
    part->range[1] = 0.7 + 1e-16;
    scene_add_load_within(s, SCENE_MEMBER_MOMENT, LOADED, 0.7005, 1, 0, 0); /* too near */
    scene_add_load_within(s, SCENE_MEMBER_MOMENT, LOADED, 0.9995, 1, 0, 0);
    scene_add_load_within(s, SCENE_MEMBER_MOMENT, OWN, 1, 1, 0, 0);
    scene_add_load_within(s, SCENE_MEMBER_FORCE, OWN, 0.5, 1, 0, 0);
}

static void pieces(const division *d)
{
    static const int expected[] = {1, 3, 2}, elements[] = {2, 6, 6};
    static const double place[] = {0, 0.1, 0.2, 0.45, 0.7, 0.85};
    for (int i = 0; i < 3; i++) {
        gsl_test_int(division_pieces(d, i), expected[i], "pieces of member %d", i);
        gsl_test_int(division_elements(d, i), elements[i], "elements of member %d", i);
    }
    for (int i = 0; i < 6; i++) {
        gsl_test_abs(division_place(d, LOADED, i, 0), place[i], 1e-15, "element %d begins", i);
        gsl_test_abs(division_inside(d, LOADED, i, place[i]), 0, 1e-14, "place of element %d", i);
    }
    gsl_test_abs(division_inside(d, LOADED, 3, 0.7), 1, 0, "a piece ends exactly");
}

static void elements_at(const division *d)
{
    static const struct {
        double place;
        int before, element;
        double x;
    } row[] = {{0, 0, 0, 0},    {0, 1, 0, 0},           {0.05, 0, 0, 0.5},      {0.2, 0, 2, 0},
               {0.2, 1, 1, 1},  {0.2 - 1e-16, 0, 2, 0}, {0.325, 0, 2, 0.5},     {0.325, 1, 2, 0.5},
               {0.45, 1, 2, 1}, {0.7, 0, 4, 0},         {0.7 + 1e-16, 1, 3, 1}, {1, 0, 5, 1},
               {1, 1, 5, 1}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        double x;
        gsl_test_int(division_at(d, LOADED, row[i].place, row[i].before, &x), row[i].element,
                     "element at %.17g, before: %d", row[i].place, row[i].before);
        gsl_test_abs(x, row[i].x, 1e-14, "point of it at %.17g, before: %d", row[i].place,
                     row[i].before);
    }
}

static void words(const scene *s)
{
    char text[400];
    division_words(s, 2, text, sizeof text);
    gsl_test(strcmp(text, "member_1 has 6 elements, 2 in each of 3 pieces: its loads begin, end or "
                          "act at 0.2, 0.7 of its length; member_2 has 6 elements, 3 in each of 2 "
                          "pieces: its loads begin, end or act at 0.5 of its length") != 0,
             "words: %s", text);
    division_words(s, 0, text, 60);
    gsl_test(strncmp(text, "member_1 has n elements in each of 3 pieces: its loads", 54) != 0,
             "words of any mesh: %s", text);
    division_words(s, 2, text, 40);
    gsl_test_int((int)strlen(text), 39, "words in little room");
}

int main(void)
{
    scene s;
    division d;
    fault f = {""};
    row(&s);
    gsl_test(division_make(&s, 2, &d, &f) != STATUS_OK, "is divided: %s", f.text);
    pieces(&d);
    elements_at(&d);
    words(&s);
    division_free(&d);
    scene_free(&s);
    return gsl_test_summary();
}
