'use strict';
// Statistical summary: number of flights, method, seeds, and deviations from the plan.

/** Adds a row to the card: a name and its paragraphs. */
function addFact(host, name, words, className = '') {
  host.append(breakable('dt', '', name));
  const cell = host.appendChild(make('dd'));
  for (const text of [].concat(words)) cell.append(make('p', className, text));
}

function countWords(counts) {
  const parts = [`${counts.planned} planned`, `${counts.counted} counted`, `${counts.passed} passed`,
    `${counts.failed_a_check} failed a check`, `${counts.broken} with a fault or no result (these count as failures)`, `${counts.missing} missing`];
  if (counts.no_checks) parts.push(`${counts.no_checks} without checks`);
  const left = counts.discarded ? `${countOf(counts.discarded, 'flight')} after the stop ${counts.discarded === 1 ? 'is' : 'are'} not counted; no other flight was excluded.`
    : 'No completed flight was excluded.';
  return `${parts.join(', ')}. ${left}`;
}

/** Returns the groups of a paired comparison, [base, candidate]; null for any other campaign. */
function comparedPair({groups, claims}) {
  return groups.length === 3 && claims.conduct?.sequential.some(({candidate_better}) => candidate_better !== undefined) ? groups.slice(1) : null;
}

function percentRange([low, high]) { return `${short(100 * low)} % to ${short(100 * high)} %`; }
function methodWords(claims) {
  const rate = percentRange, method = claims.method === 'anytime' ? 'evaluated after every flight; the interval holds at all times simultaneously'
    : 'Wilson, for a number of flights planned in advance; invalid if flights are stopped depending on their results';
  const words = [`Success rate: 95 % interval ${rate(claims.interval)} (${method}).`];
  if (claims.if_missing) {
    words.push(`If all missing flights failed: ${rate(claims.if_missing[0])}; if all passed: ${rate(claims.if_missing[1])}. No verdict before they are flown.`);
  }
  return words;
}

/** Returns the upper bound of the collision rate after n flights without a collision. */
function boundWithoutCollision({flights, three_over_n: three, limit}) {
  const rule = flights < 30 ? '' : ` (rule of three: 3/${flights} = ${short(100 * three, 3)} %)`;  // the rule is for many flights
  return `0 of ${countOf(flights, 'flight')}: upper 95 % bound ${short(100 * limit, 3)} %${rule}. A bound of 1 % requires 299 flights without a collision, 0.1 % requires 2,995.`;
}

function seedWords(conduct) {
  if (!conduct) return 'The parameters of a sweep are chosen on its seeds, so its rates are biased. Judge the chosen parameters on other seeds.';
  const tried = conduct.settings_tried === null ? '' : `, ${conduct.settings_tried} settings tried`;
  return `Planned: ${conduct.seeds}. Parameters were chosen on: ${conduct.tuned_on ?? 'not stated; rates on seeds that parameters were chosen on are biased upwards'}${tried}.`;
}

function addPlan(host, plan) {
  if (!plan) {
    addFact(host, 'plan', 'No plan was registered before the flights.');
    return;
  }
  const state = {changed: 'The plan was changed after the flights.', gone: 'The file of the plan is missing: changes cannot be detected.'}[plan.now];
  addFact(host, 'plan', [plan.question, `${plan.file}, SHA-256 ${plan.sha256.slice(0, 16)}…`]);
  const deviations = [...(state ? [state] : []), ...plan.deviations.map((words) => `Deviation: ${words}.`)];
  addFact(host, 'deviations', deviations.length ? deviations : 'None.', deviations.length ? 'bad-text' : 'pass');
}

function fillClaims(host, data) {
  const {claims, controls} = data, {conduct} = claims, pair = comparedPair(data), list = host.appendChild(make('dl', 'facts'));
  addFact(list, 'flights', (controls.length ? 'Without the control: ' : '') + countWords(claims.counts));
  if (!pair) addFact(list, 'rate', methodWords(claims));
  pair?.forEach(({group, passed, ended, low, high}, i) => addFact(list, i ? 'candidate' : 'base',
    `${groupWords(group)}: ${passed} of ${ended} passed, 95 % interval ${percentRange([low, high])}, which holds at all times simultaneously.`));
  for (const found of conduct?.sequential ?? []) {
    const className = claims.if_missing || found.verdict === 'undecided' ? '' : found.verdict === 'shown' ? 'pass' : 'bad-text';
    addFact(list, `${found.rule} (${found.group})`, found.words, className);
  }
  for (const {check, group, words, passed} of conduct?.verdicts ?? []) addFact(list, `${check} (${group})`, words, passed ? 'pass' : 'bad-text');
  if (claims.no_collision) addFact(list, 'collisions', boundWithoutCollision(claims.no_collision));
  if (conduct?.limit_s) addFact(list, 'time limit', `Flights over ${conduct.limit_s} s of wall time failed, so the result depends on the speed of the machine.`);
  addFact(list, 'seeds', seedWords(conduct));
  if (conduct) addPlan(list, conduct.plan);
}
