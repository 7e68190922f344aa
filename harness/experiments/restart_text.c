#include "harness/experiments/restart_text.h"

#include <stdlib.h>
#include <string.h>

#include "cases/format/write.h"

/* No motion has another station than this one. */
static void equal_stations(scene *plain, double *zero)
{
    for (int i = 0; i < plain->analyses; i++)
        if (plain->analysis[i].kind == SCENE_MOTION)
            plain->analysis[i].of.motion.path = (scene_path){1, zero};
}

status restart_text(const scene *s, char **out, fault *f)
{
    static const write_head head = {"motion", "a motion that continues another", "none"};
    double zero = 0;
    scene plain = *s;
    *out = NULL;
    plain.quantities = plain.meshes = 0;
    plain.analysis = malloc((size_t)(s->analyses + 1) * sizeof *plain.analysis);
    if (plain.analysis != NULL) {
        memcpy(plain.analysis, s->analysis, (size_t)s->analyses * sizeof *plain.analysis);
        equal_stations(&plain, &zero);
        *out = write_scene_text(&plain, &head);
    }
    free(plain.analysis);
    if (*out == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for the text of a scene");
    if (**out != '\0')
        return STATUS_OK;
    free(*out);
    *out = NULL;
    return fault_set(f, STATUS_REFUSED,
                     "no scene file can say this scene, by which a continued motion is identified: "
                     "leave --ends and --restart out");
}

/* Length of the line without the spaces it begins with, which are left out of it. */
static int line_of(const char **text)
{
    *text += strspn(*text, " ");
    return (int)strcspn(*text, "\n");
}

/* What is told of two lines begins before they part. */
enum { BEFORE = 30, TOLD = 70 };
static int told(int length)
{
    return length < TOLD ? length : TOLD;
}

static status differ(const char *former, const char *now, fault *f)
{
    while (*former != '\0' || *now != '\0') {
        const char *a = former, *b = now;
        const int n = line_of(&a), k = line_of(&b);
        if (n != k || memcmp(a, b, (size_t)n) != 0) {
            int same = 0;
            while (same < n && same < k && a[same] == b[same])
                same++;
            same = same > BEFORE ? same - BEFORE : 0;
            return fault_set(f, STATUS_REFUSED,
                             "--restart is of another scene: there '%.*s', here '%.*s'",
                             told(n - same), a + same, told(k - same), b + same);
        }
        former = a + n + (a[n] == '\n');
        now = b + k + (b[k] == '\n');
    }
    return STATUS_OK;
}

status restart_text_check(const char *former, const scene *s, fault *f)
{
    char *now;
    TRY(restart_text(s, &now, f));
    const status outcome = differ(former, now, f);
    free(now);
    return outcome;
}
