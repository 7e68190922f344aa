/* What a path leads to: links, the same place under many names, and what is no place for an output.
 */
#include <fcntl.h>
#include <gsl/gsl_test.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "harness/records/records.h"
#include "harness/records/test/folder.h"

/* The target of a link is replaced, not the link: near, far, over several links, and where nothing
 * is yet. */
static void links(void)
{
    const test_folder of = folder_make();
    const folder_entry target = folder_path(&of, "target"), far = folder_path(&of, "far"),
                       near = folder_path(&of, "near"), chain = folder_path(&of, "chain"),
                       new_one = folder_path(&of, "new"), dangling = folder_path(&of, "dangling"),
                       circle = folder_path(&of, "circle");
    fault f = {""};
    gsl_test(folder_write_text(target.text, "before", &f) != STATUS_OK, "a file %s", f.text);
    gsl_test(symlink(target.text, far.text) | symlink("target", near.text) |
                 symlink("near", chain.text) | symlink("new", dangling.text) |
                 symlink("circle", circle.text),
             "links");
    const folder_entry link[] = {far, near, chain};
    for (int i = 0; i < 3; i++) {
        gsl_test(folder_write_text(link[i].text, link[i].text, &f) != STATUS_OK,
                 "written through %s %s", link[i].text, f.text);
        gsl_test(!S_ISLNK(folder_mode_of(link[i].text)) || !S_ISREG(folder_mode_of(target.text)) ||
                     !folder_holds(target.text, link[i].text),
                 "it is the link that stays and its target that is new");
    }
    gsl_test(folder_write_text(dangling.text, "made", &f) != STATUS_OK ||
                 !folder_holds(new_one.text, "made"),
             "where the link leads to");
    gsl_test(!S_ISLNK(folder_mode_of(dangling.text)), "and it stays a link");
    gsl_test(folder_write_text(circle.text, "never", &f) != STATUS_FAULT, "links in a circle: %s",
             f.text);
    gsl_test_int(folder_entries(of.path), 7, "nothing else is left");
    folder_remove(&of);
}

/* What is no place for an output is said before anything is computed, in one line. */
static void no_places(void)
{
    const test_folder of = folder_make();
    const folder_entry none = folder_path(&of, "none/file"), slash = folder_path(&of, "none/");
    char longest[PATH_MAX + 100];
    memset(longest, 'x', sizeof longest - 1);
    longest[sizeof longest - 1] = '\0';
    const struct {
        const char *path;
        status outcome;
    } bad[] = {{"", STATUS_REFUSED},       {of.path, STATUS_FAULT}, {none.text, STATUS_FAULT},
               {slash.text, STATUS_FAULT}, {longest, STATUS_FAULT}, {"/nowhere/x", STATUS_FAULT}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fault f = {""};
        file_place where;
        gsl_test(output_try(bad[i].path, OUTPUT_TEXT, &where, &f) != bad[i].outcome ||
                     strchr(f.text, '\n') != NULL || f.text[0] == '\0',
                 "'%.60s': %s", bad[i].path, f.text);
    }
    gsl_test_int(folder_entries(of.path), 0, "nothing is left");
    folder_remove(&of);
}

/* One place under many names: other words, links, hard links; files that are not there yet. */
static void same_places(void)
{
    const test_folder of = folder_make();
    const folder_entry a = folder_path(&of, "a"), dotted = folder_path(&of, "./a"),
                       link = folder_path(&of, "link"), hard = folder_path(&of, "hard"),
                       b = folder_path(&of, "b"), free_a = folder_path(&of, "free"),
                       free_dotted = folder_path(&of, ".//free"),
                       free_link = folder_path(&of, "free_link"),
                       free_b = folder_path(&of, "freed");
    const char *const one[] = {a.text, dotted.text, link.text, hard.text};
    const char *const other[] = {free_a.text, free_dotted.text, free_link.text};
    fault f = {""};
    file_place x, y;
    gsl_test(folder_write_text(a.text, "x", &f) != STATUS_OK ||
                 folder_write_text(b.text, "x", &f) != STATUS_OK,
             "two files %s", f.text);
    gsl_test(symlink(a.text, link.text) != 0 ||
                 linkat(AT_FDCWD, a.text, AT_FDCWD, hard.text, 0) != 0 ||
                 symlink("free", free_link.text) != 0,
             "links");
    for (int i = 0; i < 4; i++)
        gsl_test(place_find(a.text, &x, &f) | place_find(one[i], &y, &f) || !place_same(&x, &y),
                 "the same: %s", one[i]);
    for (int i = 0; i < 3; i++)
        gsl_test(place_find(free_a.text, &x, &f) | place_find(other[i], &y, &f) ||
                     !place_same(&x, &y),
                 "the same: %s", other[i]);
    gsl_test(place_find(a.text, &x, &f) | place_find(b.text, &y, &f) || place_same(&x, &y),
             "two files are two");
    gsl_test(place_find(free_a.text, &x, &f) | place_find(free_b.text, &y, &f) ||
                 place_same(&x, &y),
             "two new ones are two");
    gsl_test(place_find(a.text, &x, &f) | place_find(free_a.text, &y, &f) || place_same(&x, &y),
             "one and a new one are two");
    folder_remove(&of);
}

int main(void)
{
    links();
    no_places();
    same_places();
    return gsl_test_summary();
}
