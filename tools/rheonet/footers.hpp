#pragma once

namespace rheonet::tool {

/// The text of each command's help below its options.
inline constexpr const char* footer_of_rheonet =
    "Examples:\n"
    "  rheonet run scene.toml -o result.csv\n"
    "  rheonet components spring\n"
    "`rheonet COMMAND --help` describes the options of a command.\n\n"
    "Ctrl-C (SIGINT) and SIGTERM end any command within 2 s, `serve` with exit status 0, all others with 1. Complete rows\n"
    "written so far are kept. A second signal ends it at once.";
inline constexpr const char* footer_of_run =
    "Examples:\n"
    "  rheonet run scene.toml -o result.csv\n"
    "  rheonet run scene.toml --set k1.stiffness=\"400 N/m\" simulate.stop=\"5 s\"\n\n"
    "Rows are CSV (FILE ends in .csv, .txt, .dat or has no ending), NetCDF-4 (.nc) or MAT (.mat); events are CSV. An interrupted run leaves the rows\n"
    "written so far; with --certify it leaves an earlier file as it was.\n\n"
    "Exit status: 0 done; 1 the scene could not be simulated, the run was interrupted, a file could not be written\n"
    "to its end, a claim of [expect] fails, or the rows could not be certified; 2 the scene or the command line is wrong, or\n"
    "an output file cannot be opened.";
inline constexpr const char* footer_of_check =
    "Exit status: 0 no mistake; 1 the scene can be read but not simulated; 2 the scene or the command line is wrong.";

inline constexpr const char* footer_of_explain =
    "Examples:\n"
    "  rheonet explain scene.toml\n"
    "  rheonet explain scene.toml --without inertia --json\n"
    "  rheonet explain --numerics\n\n"
    "Exit status: 0 done; 1 the scene can be read but not simulated; 2 the scene or the command line is wrong.";

inline constexpr const char* footer_of_effects =
    "Examples:\n"
    "  rheonet effects scene.toml\n"
    "  rheonet effects scene.toml --within 1e-4 -o effects.csv\n\n"
    "Exit status: 0 done; 1 the full model could not be simulated, the command was interrupted, or the output could\n"
    "not be written to its end; 2 the scene or the command line is wrong, or an output file cannot be opened.";

inline constexpr const char* footer_of_compare =
    "Examples:\n"
    "  rheonet compare combined.toml wired.toml --pair friction.force=chain.force --within 1e-6\n"
    "  rheonet compare combined.toml wired.toml --vary parameters.B=\"1 N*s/m:100 N*s/m:9:log\"\n\n"
    "Without --pair the records with a common name are compared, at the output times of the first scene, up to the\n"
    "end of the shortest run. RANGE is from:to:count, from:to:count:log or value,value,...; with a RANGE, -o writes\n"
    "the table of differences instead of the rows.\n\n"
    "Exit status: 0 done, and within --within; 1 not within, a scene could not be simulated, the comparison was\n"
    "interrupted (the finished values of RANGE are kept), or the output could not be written to its end; 2 a scene or the\n"
    "command line is wrong, or an output file cannot be opened.";

inline constexpr const char* footer_of_precision =
    "Examples:\n"
    "  rheonet precision scene.toml\n"
    "  rheonet precision scene.toml --accuracies 1e-3,1e-6,1e-9 -o prices.csv --plot prices.svg\n"
    "  rheonet precision one-element.toml --variant wired.toml --pair oil.force=oil.spring.force\n"
    "  rheonet precision layers.toml --variant parameters.N=10 --variant \"parameters.N=20; parameters.gap=2 mm\"\n\n"
    "Exit status: 0 done; 1 the scene could not be simulated, the command was interrupted, or the output could not\n"
    "be written to its end; 2 the scene or the command line is wrong, or an output file cannot be opened.";

inline constexpr const char* footer_of_sweep =
    "Examples:\n"
    "  rheonet sweep scene.toml --vary c1.damping=\"1 N*s/m:100 N*s/m:50:log\" --measure 'max(k1.force)' -o sweep.csv\n"
    "  rheonet sweep scene.toml --vary k1.stiffness=100:1000 --vary c1.damping=1:100:log --latin 500 -o sweep.csv\n"
    "  rheonet sweep scene.toml --vary \"m1.mass=normal(2 kg, 5 %)\" --random 1000 --measure 'max(k1.force)' --statistics s.json\n"
    "  rheonet sweep scene.toml --list cases.csv -o rows.csv\n\n"
    "RANGE is from:to:count, from:to:count:log or value,value,...; several --vary make a grid. With --random, --latin and\n"
    "--sobol it is from:to, from:to:log, value,value,..., uniform(from, to), normal(mean, deviation) or lognormal(median,\n"
    "deviation of ln). The first row of a --list FILE has paths, with units as in `k1.stiffness [N/m]`; each further row has\n"
    "the values of a run.\n\n"
    "Measures: max, min, mean, rms, final and `time of max`, `time of min` of a record, as in max(k1.force) or\n"
    "max(k1.force, from 1 s, to 2 s); value(k1.force, 0.2 s); time of crossing(k1.force, 2 N); energy dissipated, energy\n"
    "supplied, energy stored; steps, events. With measures a run is one row; without measures it has the rows of `run`. Headings have\n"
    "the SI unit of a column, as in `max(k1.force) [N]`.\n\n"
    "Exit status: 0 every run is done; 1 a run could not be read or simulated (the column `error` says why), the sweep\n"
    "was interrupted, or its rows could not be written to their end; 2 the scene or the command line is wrong, or an output file\n"
    "cannot be opened.";

inline constexpr const char* footer_of_plot =
    "Examples:\n"
    "  rheonet plot scene.toml -o forces.svg -y k1.force,c1.force\n"
    "  rheonet plot result.csv -o loop.png --domain rotation --loop bearing\n"
    "  rheonet plot coarse.csv fine.csv -o decay.svg -y oil.force --log y\n\n"
    "A FILE that ends in .toml is a scene, and is simulated. Any other FILE is a CSV file whose first row names its\n"
    "columns: output of `run` or `sweep`, or columns with units, as `torque [in*ozf]`. Without -y all columns are drawn over\n"
    "the first. Each quantity has a panel, over one horizontal axis. Each run of a sweep is a curve. A measure is a column:\n"
    "-y 'value(k1.force, 2 s)'.\n\n"
    "Exit status: 0 done; 1 a scene could not be simulated, or the figure could not be written to its end; 2 a file or the\n"
    "command line is wrong, or an output file cannot be opened.";

inline constexpr const char* footer_of_draw =
    "Examples:\n"
    "  rheonet draw scene.toml -o network.svg\n"
    "  rheonet draw scene.toml -o network.png --title 'Model A' --no-values\n\n"
    "Exit status: 0 done; 1 the figure could not be written to its end; 2 the scene or the command line is wrong, or an\n"
    "output file cannot be opened.";

inline constexpr const char* footer_of_report =
    "Examples:\n"
    "  rheonet report scene.toml -o report.html\n"
    "  rheonet report stiff.toml soft.toml -o both.html --certify\n\n"
    "The report is one file. It opens in any browser without a network, and prints well.\n\n"
    "Exit status: 0 done; 1 a scene could not be simulated to its end, a claim of [expect] fails, a scene could not be\n"
    "certified (the report says so), or the report could not be written to its end; 2 a scene or the command line is wrong, or an\n"
    "output file cannot be opened.";

inline constexpr const char* footer_of_serve =
    "Examples:\n"
    "  rheonet serve\n"
    "  rheonet serve my-netlists --port 8080\n\n"
    "The address that is printed ends with a token: open it as it is. Without the token nobody gets in, no other user of this\n"
    "machine either.\n\n"
    "Exit status: 0 ended by Ctrl-C; 1 the address cannot be used, or the web pages are missing; 2 the command line is wrong.";

}  // namespace rheonet::tool
