/** What the server keeps of a class, as src/remote/classroom.cpp does. */

export interface Pupil {
  id: number;
  name: string;
  role: 'viewer' | 'student' | 'instructor';
  hand: number;
}

interface Said {
  hand_up: boolean;
  answer: string | null;
}

type Control = Record<string, unknown>;

export interface Refusal {
  value: number; // of its Event
  text: string;
}

export const NOT_INSTRUCTOR: Refusal = { value: 1, text: 'only an instructor leads the class' };
const CLOSED: Refusal = { value: 2, text: 'this question is no longer asked' };

export class Classroom {
  pupils: Pupil[] = [];
  frozen = false;
  join = ''; // the link for students
  private look: unknown = null;
  private question: { id: string; options: string[] } | null = null;
  private lesson: unknown = null;
  private readonly said = new Map<number, Said>();
  private readonly results: Control[] = [];

  /** Gives back why it is refused, where it is. */
  obey(pupil: Pupil, { do: wish, ...fields }: Control): Refusal | null {
    const said = this.said.get(pupil.id) ?? { hand_up: false, answer: null };
    this.said.set(pupil.id, said);
    if (wish === 'class_hand_up') said.hand_up = fields['on'] === true;
    else if (wish === 'class_answer') {
      if (fields['question'] !== this.question?.id) return CLOSED;
      said.answer = String(fields['answer']);
    } else if (wish === 'class_result') {
      this.results.push({ ...fields, client: pupil.id, name: pupil.name, number: this.results.length + 1 });
    } else if (pupil.role !== 'instructor') return NOT_INSTRUCTOR;
    else if (wish === 'class_freeze') this.frozen = fields['on'] === true;
    else if (wish === 'class_look') this.look = fields['look'];
    else if (wish === 'class_ask') this.ask(fields['question']);
    else if (wish === 'class_lesson') this.lesson = fields['lesson'];
    return null;
  }

  announcement(to: Pupil): Control {
    const hands_up = [...this.said].filter(([, { hand_up }]) => hand_up).map(([id]) => id);
    const students = this.pupils.filter(({ role }) => role === 'student').length;
    const { frozen, look, question, lesson } = this;
    const all = { frozen, look, question, lesson, students, hands_up };
    if (to.role !== 'instructor') return { class: all };
    const members = this.pupils.map((pupil) => ({ ...pupil, answer: this.said.get(pupil.id)?.answer ?? null }));
    return { class: { ...all, join: this.join, members, results: this.results } };
  }

  private ask(question: unknown): void {
    this.question = question as { id: string; options: string[] } | null;
    for (const said of this.said.values()) said.answer = null;
  }
}
