#include "harness/terminal/screen.h"

#include <langinfo.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const inks[] = {[SCREEN_PLAIN] = "",
                                   [SCREEN_GOOD] = "\033[32m",
                                   [SCREEN_BAD] = "\033[1;31m",
                                   [SCREEN_FAINT] = "\033[2m"};

static int has_colour(FILE *to)
{
    const char *terminal = getenv("TERM"), *none = getenv("NO_COLOR");
    return isatty(fileno(to)) && terminal != NULL && strcmp(terminal, "dumb") != 0 &&
           (none == NULL || none[0] == '\0');
}

/* Of the environment, whatever locale the program itself keeps to. */
static int has_utf8(void)
{
    const locale_t here = newlocale(LC_CTYPE_MASK, "", (locale_t)0);
    if (here == (locale_t)0)
        return 0;
    const int utf8 = strcmp(nl_langinfo_l(CODESET, here), "UTF-8") == 0;
    freelocale(here);
    return utf8;
}

screen screen_of(FILE *to)
{
    return (screen){.colour = has_colour(to), .utf8 = has_utf8()};
}

void screen_put(FILE *to, screen look, screen_ink ink, const char *text)
{
    const int painted = look.colour && ink != SCREEN_PLAIN;
    fprintf(to, "%s%s%s", painted ? inks[ink] : "", text, painted ? "\033[0m" : "");
}
