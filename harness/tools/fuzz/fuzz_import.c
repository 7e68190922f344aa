/* Uses the input as results of another program: a CSV with a header (first byte 0), a map of
 * columns (1), or columns that are read with a valid map (2). Accepted results must be a series of
 * finite values in ascending order. An error must have a position. */
#include <math.h>

#include "harness/import_export/import_export.h"
#include "harness/tools/fuzz/fuzz_file.h"

enum { FORMS = 3 };

#define MAPS "harness/import_export/"
#define DATA "harness/import_export/test/data/"

static status read_form(int form, const char *path, import_set *set, mistakes *m, fault *f)
{
    const char *const columns[] = {DATA "mbdyn_sheet.mov", DATA "mbdyn_sheet.jnt"};
    m->file = path;
    if (form == 0)
        return import_file_read(path, set, m, f);
    if (form == 1)
        return import_map_read(path, columns, 2, set, m, f);
    return import_map_read(MAPS "calculix_dat.yaml", &path, 1, set, m, f);
}

static void check_values(const imported *found)
{
    fuzz_must(found->rows > 0, "a series has values");
    for (int i = 0; i < found->rows; i++) {
        const imported_row *row = &found->row[i];
        fuzz_must(row->elements >= 1 && (i == 0 || found->row[i - 1].elements <= row->elements),
                  "its meshes ascend");
        fuzz_must(isfinite(row->value) && isfinite(row->factor) && row->factor != 0,
                  "a converted value is finite");
        fuzz_must(isnan(row->uncertainty) || row->uncertainty >= 0, "no uncertainty is negative");
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    import_set set = {0};
    mistakes m = {0};
    fault f = {""};
    if (size == 0)
        return 0;
    const status outcome = read_form(data[0] % FORMS, fuzz_file(data + 1, size - 1), &set, &m, &f);
    fuzz_must((outcome == STATUS_OK) == (f.text[0] == '\0') && strchr(f.text, '\n') == NULL,
              "a rejection has a one-line error");
    fuzz_must(outcome != STATUS_OK || m.count == 0, "a file with mistakes is rejected");
    for (int i = 0; i < m.count; i++)
        fuzz_must(m.list[i].line >= 1 && m.list[i].column >= 1 && m.list[i].text[0] != '\0' &&
                      strchr(m.list[i].text, '\n') == NULL,
                  "a mistake has a position and a text of one line");
    for (int i = 0; i < set.sweep.seriess && outcome == STATUS_OK; i++)
        check_values(set.sweep.series[i].imported);
    import_block_free_set(&set);
    return 0;
}
