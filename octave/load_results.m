% Results of a run of `pounding` for Octave, as matrices with one row per sample. SI units throughout.
%
%     addpath("octave");                                   % of the repository, or share/pounding/octave
%     run = load_results("results/demo");
%     plot(run.time, run.of("displacement", "floor2.x"));
%     [frequency, acceleration] = run.spectrum("floor2", "x", 0.05);
%
% run.time [s]; run.of(quantity, column) of displacement, velocity (half a time step later), acceleration, gap,
% contact_force, force, link_force, link_elongation; run.names(quantity) are the columns; run.summary is summary.json;
% run.spectrum(probe, direction, damping) is the pseudo-acceleration [m/s2] over the frequency [Hz].
% Stops with an error that names what is not there.
function result = load_results(folder)
  path = fullfile(folder, "history.h5");
  if ! exist(path, "file")
    error("load_results: %s is not there; give the output folder of a run", path);
  end
  result.summary = jsondecode(fileread(fullfile(folder, "summary.json")), "makeValidName", false);
  if ! isfield(result.summary, "schema") || result.summary.schema != 1
    error("load_results: the results in %s are not of schema 1, which is read here; make the run anew", folder);
  end
  history = load("-hdf5", path);
  rows = numel(history.time);
  if isfield(history, "records")  % rows behind them were still being written when the run ended
    rows = history.records(1);
  end
  labels = struct("displacement", "channels", "velocity", "channels", "acceleration", "channels", "gap", "contacts", ...
                  "contact_force", "contacts", "force", "forces", "base_displacement", "bases", "rotation", "rotations", ...
                  "link_force", "links", "link_elongation", "links");
  columns = values = struct();
  for [label, quantity] = labels
    if isfield(history, quantity)
      columns.(quantity) = cellstr(strrep(history.(label), "\0", " "));
      values.(quantity) = history.(quantity)(:, 1:rows).';  % HDF5 counts its dimensions the other way round
    end
  end
  result.time = history.time(1:rows)(:);
  result.ground_acceleration = history.ground_acceleration(:, 1:rows).';
  result.names = @(quantity) member(columns, quantity);
  result.of = @(quantity, name) member(values, quantity)(:, place(name, member(columns, quantity)));
  result.spectrum = @(probe, direction, damping) one_spectrum(fullfile(folder, "spectra.csv"), probe, direction, damping);
end

function found = member(values, quantity)
  if ! isfield(values, quantity)
    error("load_results: no %s in the history", quantity);
  end
  found = values.(quantity);
end

function found = place(name, names)
  found = find(strcmp(name, names));
  if isempty(found)
    error("load_results: no column %s; there are %s", name, strjoin(names.', ", "));
  end
end

function [frequency, acceleration] = one_spectrum(path, probe, direction, damping)
  lines = strsplit(fileread(path), "\n");
  lines = lines(! strncmp(lines, "#", 1) & ! cellfun(@isempty, lines));
  header = strsplit(lines{1}, ",");
  parts = cellfun(@(line) strsplit(line, ","), lines(2:end), "UniformOutput", false);
  table = vertcat(parts{:});
  number = @(name) str2double(table(:, strcmp(name, header)));
  rows = strcmp(table(:, strcmp("probe", header)), probe) ...
         & strcmp(table(:, strcmp("direction", header)), direction) & number("damping") == damping;
  if ! any(rows)
    error("load_results: no spectrum of %s along %s for damping %g", probe, direction, damping);
  end
  frequency = number("frequency")(rows);
  acceleration = number("pseudo_acceleration")(rows);
end
