/** Who hears of what. */
export class Emitter<Events> {
  private readonly listeners = new Map<keyof Events, Set<(value: never) => void>>();

  /** Gives back what stops the listening. */
  on<K extends keyof Events>(event: K, listener: (value: Events[K]) => void): () => void {
    const those = this.listeners.get(event) ?? new Set();
    this.listeners.set(event, those);
    those.add(listener as (value: never) => void);
    return () => those.delete(listener as (value: never) => void);
  }

  emit<K extends keyof Events>(event: K, value: Events[K]): void {
    for (const listener of [...(this.listeners.get(event) ?? [])]) (listener as (value: Events[K]) => void)(value);
  }
}
