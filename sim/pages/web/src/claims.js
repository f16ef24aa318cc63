'use strict';
// What must stand beside a rate: how many flights, which method, which seeds, and whether it went as planned.

/** A line of the card: a name and words, one paragraph each. */
function addFact(host, name, words, className = '') {
  host.append(make('dt', '', name));
  const cell = host.appendChild(make('dd'));
  for (const text of [].concat(words)) cell.append(make('p', className, text));
}

function countWords(counts) {
  const parts = [`${counts.planned} planned`, `${counts.counted} counted`, `${counts.passed} passed`,
    `${counts.failed_a_check} failed a check`, `${counts.broken} with a fault or no result (these count as failures)`, `${counts.missing} missing`];
  if (counts.no_checks) parts.push(`${counts.no_checks} without checks`);
  const left = counts.discarded ? `${counts.discarded} past the stop do not count, whatever they did; no other flight was left out.`
    : 'No flight that ended was left out.';
  return `${parts.join(', ')}. ${left}`;
}

function methodWords(claims) {
  const rate = ([low, high]) => `${short(100 * low)} % to ${short(100 * high)} %`;
  const method = claims.method === 'anytime' ? 'looked at after every flight; the interval holds at all times together'
    : 'Wilson, for a number of flights planned in advance; it would not hold for flights that are stopped when they look good';
  const words = [`Success rate within ${rate(claims.interval)}, 95 % (${method}).`];
  if (claims.if_missing) {
    words.push(`With the missing flights as failures ${rate(claims.if_missing[0])}, as passes ${rate(claims.if_missing[1])}: no verdict before they are flown.`);
  }
  return words;
}

/** Nothing happened in n flights: what that shows, and what it does not. */
function nothingHappened({flights, three_over_n: three, limit}) {
  return `None in ${flights} flights: with 95 % confidence fewer than ${short(100 * limit, 3)} % of all flights collide (rule of three: 3/${flights} = ${short(100 * three, 3)} %). It takes 299 flights without a collision to show 1 %, 2,995 to show 0.1 %.`;
}

function seedWords(conduct) {
  if (!conduct) return 'A sweep chooses parameters on its seeds: its rates judge nothing. Fly what it found on other seeds.';
  const tried = conduct.settings_tried === null ? '' : `, ${conduct.settings_tried} settings tried`;
  return `Planned: ${conduct.seeds}. Parameters were chosen on: ${conduct.tuned_on ?? 'nobody said; a rate on seeds that parameters were chosen on is too good'}${tried}.`;
}

function addPlan(host, plan) {
  if (!plan) {
    addFact(host, 'plan', 'None was registered before the flights.');
    return;
  }
  const state = {changed: 'The plan was changed after the flights.', gone: 'The plan’s file is gone: whether it was changed is not known.'}[plan.now];
  addFact(host, 'plan', [plan.question, `${plan.file}, SHA-256 ${plan.sha256.slice(0, 16)}…`]);
  const deviations = [...(state ? [state] : []), ...plan.deviations.map((words) => `Deviation: ${words}.`)];
  addFact(host, 'as registered', deviations.length ? deviations : 'Yes.', deviations.length ? 'bad-text' : 'pass');
}

function fillClaims(host, claims) {
  const {conduct} = claims, list = host.appendChild(make('dl', 'facts'));
  addFact(list, 'flights', countWords(claims.counts));
  addFact(list, 'rate', methodWords(claims));
  for (const found of conduct?.sequential ?? []) {
    const className = claims.if_missing || found.verdict === 'undecided' ? '' : found.verdict === 'shown' ? 'pass' : 'bad-text';
    addFact(list, `${found.rule} (${found.group})`, found.words, className);
  }
  if (claims.no_collision) addFact(list, 'collisions', nothingHappened(claims.no_collision));
  if (conduct?.limit_s) addFact(list, 'limit', `Flights over ${conduct.limit_s} s of wall time failed: the machine’s speed enters.`);
  addFact(list, 'seeds', seedWords(conduct));
  if (conduct) addPlan(list, conduct.plan);
}
