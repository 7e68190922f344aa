"""Small commands for each verb, and its options for output files."""
VERBS = ("list", "solve", "converge", "bench", "stress", "verify", "truth", "compare")
EVERY_VERB = ("list", "explain", "solve", "plot", "converge", "sweep", "truth", "scene", "verify",
              "bench", "stress", "motion", "element-test", "merge", "compare", "export", "import", "schema")
WORK = {
    "verify": ("-k", "warping_torsion/default and beamw_vlasov"),
    "solve": ("warping_torsion", "-f", "beamw", "-n", "2"),
    "converge": ("warping_torsion", "-f", "beamw", "-n", "2,4,8"),
    "bench": ("warping_torsion", "-f", "beamw", "-n", "2"),
    "stress": ("-k", "decay_free and collocation"),
    "sweep": ("warping_torsion", "--vary", "kL=1,2", "-f", "beamw", "-n", "2"),
}
# options for output files, either for text or for HDF5
TEXT = {"verify": ("--json", "--junit", "--markdown"), "solve": ("-o",), "converge": ("-o",),
        "stress": ("-o", "--json"), "bench": (), "sweep": ()}
WHOLE = {"verify": ("-o",), "bench": ("-o",), "solve": ("--shapes=1", "-o"), "converge": (),
         "stress": (), "sweep": ("-o",)}
# options that accept both forms, depending on the name of the file
BOTH = {("converge", "-o"), ("stress", "-o")}
