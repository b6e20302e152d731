% A matrix that `-export_matrices` wrote (Matrix Market, real coordinates) as a sparse matrix, for Octave and Matlab.
%
%     addpath('octave');                                   % of the repository, or share/pounding/octave
%     K = read_matrix('results/matrices/s1/stiffness.mtx');
%
% Rows and columns are those of dofs.csv in the same folder; SI units. Stops with an error that names the path where the
% file is missing, is of another kind or ends too early.
function matrix = read_matrix(path)
  file = fopen(path, 'r');
  if file < 0
    error('read_matrix: %s cannot be read', path);
  end
  closing = onCleanup(@() fclose(file));
  banner = lower(fgetl(file));
  if isempty(regexp(banner, '^%%matrixmarket matrix coordinate real (general|symmetric)\s*$', 'once'))
    error('read_matrix: %s is no real Matrix Market file of coordinates', path);
  end
  line = fgetl(file);
  while ischar(line) && (isempty(strtrim(line)) || line(1) == '%')
    line = fgetl(file);
  end
  sizes = sscanf(line, '%d');
  entries = fscanf(file, '%f', [3 Inf])';
  if numel(sizes) ~= 3 || size(entries, 1) ~= sizes(3)
    error('read_matrix: %s ends too early', path);
  end
  matrix = sparse(entries(:, 1), entries(:, 2), entries(:, 3), sizes(1), sizes(2));
  if ~isempty(strfind(banner, 'symmetric'))
    matrix = matrix + tril(matrix, -1)';
  end
end
