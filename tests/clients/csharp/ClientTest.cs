// The C# client against the golden vectors, and what a path gets in lockstep:
//   ClientTest vectors FOLDER | ClientTest drive PORT STATES FILE LINE | ClientTest hand PORT TOKEN
using System;
using System.IO;
using System.Linq;
using System.Reflection;
using Myotact;

static class ClientTest
{
    static void Require(bool promise, string what)
    {
        if (!promise) throw new Exception("not so: " + what);
    }

    static Frame Vector(string folder, string name)
    {
        return Wire.Parse(File.ReadAllBytes(Path.Combine(folder, name + ".bin")));
    }

    static void Vectors(string folder)
    {
        foreach (string file in Directory.GetFiles(folder, "*.bin"))
        {
            byte[] bytes = File.ReadAllBytes(file);
            Require(Wire.Bytes(Wire.Parse(bytes)).SequenceEqual(bytes), file);
        }
        var token = Enumerable.Range(0, 16).Select(i => (byte)i).ToArray();
        Frame hello = Wire.Hello(1, 3, 2, 0x1122334455667788, token, "Zo\u00EB");
        Require(hello.Payload.SequenceEqual(Vector(folder, "hello").Payload), "hello");
        var state = new ToolState
        {
            PositionWorldM = new[] { 0.1, -0.2, 0.3 }, ProxyWorldM = new[] { 0.11, -0.21, 0.31 },
            ForceWorldN = new[] { 1.5, -2.5, 0.5 }, Sequence = 12345678901, ModelSequence = 4321, Buttons = 5, Faults = 9,
            Contact = new Contact
            {
                Surface = 3, Triangle = 77, Barycentric = new[] { 0.25, 0.5, 0.25 }, NormalWorld = new[] { 0, 0.6, 0.8 },
                TargetWorldM = new[] { 0.1, 0.2, 0.3 }, StiffnessNPerM = 812.5, TouchedWorldM = new[] { 0.11, 0.21, 0.31 }
            },
            Grip = new Grip
            {
                Line = 2, Body = 1, LineFraction = 0.3, LineStiffnessNPerM = 250, BodyPointRestM = new[] { 0.01, 0.02, 0.03 },
                BodyTargetWorldM = new[] { 0.04, 0.05, 0.06 }, BodyStiffnessNPerM = 333.25
            }
        };
        var names = new[] { "tool_contact", "tool_grip", "tool_state" };
        var frames = Wire.Frames(state);
        for (int i = 0; i < 3; ++i)
        {
            Frame wanted = Vector(folder, names[i]);
            Require(frames[i].Type == wanted.Type && frames[i].Flags == wanted.Flags, names[i]);
            Require(frames[i].Payload.SequenceEqual(wanted.Payload), names[i]);
        }
        Force force = MyotactClient.ForceOf(Vector(folder, "force"));
        Require(force.Step == 42 && force.WorldN.SequenceEqual(new[] { 0.1, -0.2, 0.3 }), "force");
    }

    static void Scene(string folder)
    {
        var decoder = new SceneDecoder();
        Require(!decoder.Take(Vector(folder, "scene_key")) && !decoder.Take(Vector(folder, "scene_delta")), "not whole yet");
        Require(decoder.Take(Vector(folder, "bone_poses")), "whole");
        var grid = new[] { 10000, 19999, 30064 };
        for (int i = 0; i < 3; ++i) Require(Math.Abs(decoder.SkinsWorldM[0][i] - 1e-5 * grid[i]) < 1e-12, "skin");
        Require(decoder.Poses[0][11] == 0.3, "pose");
        foreach (string name in new[] { "scene_key", "scene_delta", "bone_poses" }) CutOff(decoder, Vector(folder, name));
    }

    static void CutOff(SceneDecoder decoder, Frame whole)
    {
        for (int length = 0; length < whole.Payload.Length; ++length)
        {
            Frame cut = whole;
            cut.Payload = whole.Payload.Take(length).ToArray();
            Require(IsRefused(decoder, cut), length + " bytes are no " + whole.Type);
        }
    }

    static bool IsRefused(SceneDecoder decoder, Frame frame)
    {
        try { decoder.Take(frame); }
        catch (WireException) { return true; }
        return false;
    }

    static void Axes()
    {
        double[] cranial = WorldAxes.ToEngine(new double[] { 1, 0, 0 });
        Require(cranial.SequenceEqual(new double[] { 0, 0, 1 }), "cranial is forward");
        Require(WorldAxes.ToEngine(new double[] { 0, 1, 0 }).SequenceEqual(new double[] { -1, 0, 0 }), "left is left");
        Require(WorldAxes.ToEngine(new double[] { 0, 0, 1 }).SequenceEqual(new double[] { 0, 1, 0 }), "up is up");
        var some = new[] { 0.3, -0.7, 1.1 };
        // y x z = x: this triangle faces cranially, and so forward; the engine's cross product of its corners says so, too.
        var corners = new[] { new double[] { 0, 0, 0 }, new double[] { 0, 1, 0 }, new double[] { 0, 0, 1 } };
        int[] order = WorldAxes.Triangle(0, 1, 2);
        double[] a = WorldAxes.ToEngine(corners[order[1]]), b = WorldAxes.ToEngine(corners[order[2]]);
        Require(a[1] * b[2] - a[2] * b[1] == 0 && a[2] * b[0] - a[0] * b[2] == 0 && a[0] * b[1] - a[1] * b[0] == 1,
                "outside is outside");
        Require(WorldAxes.ToWorld(WorldAxes.ToEngine(some)).SequenceEqual(some), "there and back");
        Require(WorldAxes.ToEngine(WorldAxes.ToWorld(some)).SequenceEqual(some), "and the other way");
    }

    static void Drive(int port, int states, string file, int line)
    {
        using (var output = File.Create(file))
        using (var client = new MyotactClient("127.0.0.1", port, Role.Student, Wants.Hand | Wants.Frames | Wants.Readings))
        {
            client.OnBytes = bytes => output.Write(bytes, 0, bytes.Length);
            for (int i = 0; i < states; ++i)
            {
                // Numbers that every language computes to the same bits.
                var hand = new[] { 0.001 * (i % 30), -0.0005 * (i % 20), 0.00025 * (i % 40) };
                var state = new ToolState { PositionWorldM = hand, ProxyWorldM = hand, Sequence = (ulong)i };
                if (line >= 0 && i >= 10) state.Grip = new Grip { Line = line, LineFraction = 0.5, LineStiffnessNPerM = 100 };
                client.SendState(state, 1000000UL * (ulong)i);
                client.ReadUntil(FrameType.LocalModel);
            }
        }
    }

    /// The behaviour as an engine calls it, ten times slower than usual, until it feels what it should.
    static void Hand(int port, string token)
    {
        var hand = new MyotactHand { Port = port, Token = token, MetresPerUnit = 0.1f };
        hand.transform.position = new UnityEngine.Vector3(0.1f, -0.15f, 0.2f);
        hand.enabled = true;
        // f = -k x, k = 30 N/m, in the engine's axes as in the world's.
        var wanted = new UnityEngine.Vector3(-0.3f, 0.45f, -0.6f);
        for (int i = 0; i < 500 && hand.enabled && !IsNear(hand.ForceNewtons, wanted); ++i) Update(hand);
        Require(IsNear(hand.ForceNewtons, wanted), "the spring pulls back: " + Text(hand.ForceNewtons));
        Console.WriteLine("felt");
        for (int i = 0; i < 500 && hand.enabled; ++i) Update(hand);
        Require(!hand.enabled && IsNear(hand.ForceNewtons, new UnityEngine.Vector3()), "without a server, without a force");
        hand.enabled = true;
        Require(!hand.enabled, "nobody is there");
    }

    static bool IsNear(UnityEngine.Vector3 a, UnityEngine.Vector3 b)
    {
        return Math.Abs(a.x - b.x) < 1e-4 && Math.Abs(a.y - b.y) < 1e-4 && Math.Abs(a.z - b.z) < 1e-4;
    }

    static string Text(UnityEngine.Vector3 v)
    {
        return v.x + " " + v.y + " " + v.z;
    }

    static void Update(MyotactHand hand)
    {
        const BindingFlags Own = BindingFlags.Instance | BindingFlags.NonPublic;
        typeof(MyotactHand).GetMethod("FixedUpdate", Own).Invoke(hand, null);
        System.Threading.Thread.Sleep(20);
    }

    static int Main(string[] arguments)
    {
        if (arguments[0] == "vectors")
        {
            Vectors(arguments[1]);
            Scene(arguments[1]);
            Axes();
        }
        if (arguments[0] == "drive")
            Drive(int.Parse(arguments[1]), int.Parse(arguments[2]), arguments[3], int.Parse(arguments[4]));
        if (arguments[0] == "hand") Hand(int.Parse(arguments[1]), arguments[2]);
        return 0;
    }
}
