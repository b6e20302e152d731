% The step with Octave's sparse matrices, on the matrix of a folder: two products, K u and C v with
% C = alpha M + beta K. Answers as step_benchmark does.
1;

function matrix = read_matrix(path)
  % PETSc's binary format, big-endian.
  file = fopen(path, "r", "ieee-be");
  head = fread(file, 4, "int32");
  assert(head(1) == 1211216);
  lengths = fread(file, head(2), "int32");
  columns = fread(file, head(4), "int32") + 1;
  rows = repelems(1:head(2), [1:head(2); lengths'])';
  values = fread(file, head(4), "double");
  fclose(file);
  matrix = sparse(rows, columns, values, head(2), head(3));
endfunction

function vector = read_vector(path)
  file = fopen(path, "r", "ieee-be");
  head = fread(file, 2, "int32");
  assert(head(1) == 1211214);
  vector = fread(file, head(2), "double");
  fclose(file);
endfunction

function [u, v, n] = run_steps(steps, u, v, n, K, C, inverse_mass, motion, model)
  for i = 1:steps
    acting = model.time_step;
    if n == 0
      acting = acting / 2;
    else
      u += model.time_step * v;
    end
    x = n * model.time_step / model.motion_step;
    k = floor(x);
    ground = 0;
    if k + 2 <= numel(motion)
      ground = motion(k + 1) + (x - k) * (motion(k + 2) - motion(k + 1));
    end
    v -= acting * (inverse_mass .* (K * u + C * v) + ground);
    n += 1;
  end
endfunction

function line = read_line()
  % Byte by byte, since fgetl waits for what follows the end of the line. Empty at the end of input.
  line = "";
  while !isempty(letter = fread(stdin, 1, "uint8=>char")) && letter != "\n"
    line(end + 1) = letter;
  end
endfunction

folder = argv(){end};
model = jsondecode(fileread([folder "/model.json"]));
K = read_matrix([folder "/stiffness.petsc"]);
mass = read_vector([folder "/mass.petsc"]);
C = spdiags(model.alpha * mass, 0, rows(K), rows(K)) + model.beta * K;
inverse_mass = 1 ./ mass;
motion = load(model.motion);
u = zeros(rows(K), 1);
v = u;
n = 0;

start = tic();
[u, v, n] = run_steps(model.first_steps, u, v, n, K, C, inverse_mass, motion, model);
once = toc(start) / model.first_steps;
printf('{"name": "octave", "dofs": %d, "ranks": 1, "displacement_square": %.17g}\n', rows(K), u' * u);
printf('{"ready": true}\n');
fflush(stdout);
while !isempty(line = read_line())
  steps = max(1, floor(str2double(strsplit(line){2}) / once));
  start = tic();
  [u, v, n] = run_steps(steps, u, v, n, K, C, inverse_mass, motion, model);
  once = toc(start) / steps;
  printf('{"name": "octave", "steps": %d, "seconds_per_step": %.9g}\n', steps, once);
  fflush(stdout);
end
