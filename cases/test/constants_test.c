/* What a section of a scene comes to follows its description. */
#include <gsl/gsl_test.h>

#include "cases/scene/scene.h"

/* However often it was asked for. */
static void constants_follow(void)
{
    scene s;
    fault f;
    section c;
    scene_init(&s, "constants");
    section_spec spec = section_spec_rectangle(1, 1, 2, 2);
    const int i = scene_add_section(&s, &spec);
    for (int times = 0; times < 2; times++)
        gsl_test(scene_constants(&s, i, &c, &f) != STATUS_OK || c.A != 4, "area %g", c.A);
    s.section[i].width = 3;
    gsl_test(scene_constants(&s, i, &c, &f) != STATUS_OK || c.A != 6, "of another one: %g", c.A);
    s.section[i].width = -1;
    gsl_test_int((int)scene_constants(&s, i, &c, &f), STATUS_REFUSED, "of none: %s", f.text);
    scene_free(&s);
}

int main(void)
{
    constants_follow();
    return gsl_test_summary();
}
